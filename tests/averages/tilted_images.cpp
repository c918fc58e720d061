// SPDX-License-Identifier: BSD-3-Clause
// Averages in tilted periodic boxes, against those of a scene in which each image is a particle of its own.
#include "made_points.h"

#include "granular/common/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

using namespace granular;

namespace
{
struct Tilted
{
  const char* boundary;
  Vector3 origin;
  std::array<Vector3, 3> edges;

  Box box() const
  {
    Box box = Box::from_edges(origin, edges);
    box.boundary = boundary;
    return box;
  }

  bool repeats(std::size_t axis) const { return boundary[3 * axis] == 'p'; }

  Vector3 at(const Vector3& parts, const Vector3& from) const
  {
    Vector3 place = from;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        place[axis] += parts[i] * edges[i][axis];
      }
    }
    return place;
  }
};

const Tilted boxes[] = {
  { "pp pp pp", { -1, 0, 2 }, { { { 2, 0, 0 }, { 0.6, 3, 0 }, { -0.4, 0.7, 1 } } } },
  { "pp pp pp", { 0, 0, 0 }, { { { 2, 0, 0 }, { 1, 1.5, 0 }, { -0.9, 0.7, 1.2 } } } },
  { "pp pp pp", { 7, -3, 0 }, { { { 2, 0, 0 }, { 5, 1.5, 0 }, { -3, 2.2, 1 } } } },
  { "pp ff pp", { -1, 0, 2 }, { { { 2, 0, 0 }, { 0.6, 3, 0 }, { -0.4, 0.7, 1 } } } },
  { "ff pp ff", { -1, 0, 2 }, { { { 2, 0, 0 }, { 0.6, 3, 0 }, { -0.4, 0.7, 1 } } } },
  { "ff ff pp", { -1, 0, 2 }, { { { 2, 0, 0 }, { 0.6, 3, 0 }, { -0.4, 0.7, 1 } } } },
};

/// Particles and contacts all over a box, and a box length beyond it.
Scene scene_in(const Tilted& tilted, unsigned seed)
{
  Scene scene = random_scene(30, 30, 10, { 0, 0, 0 }, { 1, 1, 1 }, seed, 0.25);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> part(-0.5, 1.5);
  const auto place = [&] {
    return tilted.at({ part(random), part(random), part(random) }, tilted.origin);
  };
  for (Particle& particle : scene.particles)
  {
    particle.x = place();
  }
  for (std::vector<Touch>* const touches : { &scene.pairs, &scene.walls })
  {
    for (Touch& touch : *touches)
    {
      const Vector3 branch = branch_of(touch);
      touch.from = place();
      touch.to = { touch.from[0] + branch[0], touch.from[1] + branch[1],
        touch.from[2] + branch[2] };
    }
  }
  return with_ends(scene);
}

/// The scene with all images that are less than `reach` from the bounds, without a box. Lines are short.
Scene with_images(const Scene& scene, const Tilted& tilted, const EulerGrid& grid, double reach)
{
  constexpr int most[] = { 30, 12, 6 }; // a tilt is made up for by many of the vectors before
  const auto range = [&](std::size_t axis) { return tilted.repeats(axis) ? most[axis] : 0; };
  const auto is_near = [&](const Vector3& place)
  {
    bool is = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      is = is && place[axis] > grid.lo[axis] - reach && place[axis] < grid.hi[axis] + reach;
    }
    return is;
  };
  Scene all;
  for (int i = -range(0); i <= range(0); ++i)
  {
    for (int j = -range(1); j <= range(1); ++j)
    {
      for (int k = -range(2); k <= range(2); ++k)
      {
        const Vector3 counts = { double(i), double(j), double(k) };
        for (Particle particle : scene.particles)
        {
          particle.x = tilted.at(counts, particle.x);
          if (is_near(particle.x))
          {
            all.particles.push_back(particle);
            all.ids.push_back(static_cast<std::int64_t>(all.ids.size()) + 1);
          }
        }
        const auto add = [&](const std::vector<Touch>& from, std::vector<Touch>& to)
        {
          for (Touch touch : from)
          {
            touch.id1 = 1;
            touch.id2 = 1;
            touch.from = tilted.at(counts, touch.from);
            touch.to = tilted.at(counts, touch.to);
            if (is_near(touch.from))
            {
              to.push_back(touch);
            }
          }
        };
        add(scene.pairs, all.pairs);
        add(scene.walls, all.walls);
      }
    }
  }
  return all;
}

/// The largest error of any array, of its largest value.
double error_of(const EulerAverages& found, const EulerAverages& expected)
{
  double error = 0;
  const auto compare = [&](const std::vector<double>& a, const std::vector<double>& b)
  {
    ASSERT_EQ(a.size(), b.size());
    double largest = 0;
    double worst = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
    {
      largest = std::max(largest, std::abs(b[i]));
      worst = std::max(worst, std::abs(a[i] - b[i]));
    }
    error = std::max(error, worst == 0 ? 0 : worst / largest);
  };
  for (const EulerArray& array : euler_arrays())
  {
    compare(found.cells.*array.values, expected.cells.*array.values);
  }
  for (const EulerField& field : euler_fields)
  {
    compare(found.fields.*field.values, expected.fields.*field.values);
  }
  return error;
}

/// The bounds of a box.
EulerGrid bounds_of(const Tilted& tilted, const std::array<std::int64_t, 3>& counts)
{
  EulerGrid grid = { tilted.origin, tilted.origin, counts };
  for (int corner = 0; corner < 8; ++corner)
  {
    const Vector3 place = tilted.at(
      { double(corner & 1), double(corner >> 1 & 1), double(corner >> 2) }, tilted.origin);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      grid.lo[axis] = std::min(grid.lo[axis], place[axis]);
      grid.hi[axis] = std::max(grid.hi[axis], place[axis]);
    }
  }
  return grid;
}
}

TEST(TiltedImages, CellsHaveWhatEachImageAsAParticleGivesThem)
{
  unsigned seed = 1;
  for (const Tilted& tilted : boxes)
  {
    const Scene scene = scene_in(tilted, ++seed);
    const Box box = tilted.box();
    const EulerGrid whole = bounds_of(tilted, { 5, 4, 6 });
    const Vector3 beside = tilted.at({ 1.7, -0.4, 0.8 }, tilted.origin);
    const EulerGrid part = { beside, { beside[0] + 1, beside[1] + 0.6, beside[2] + 0.8 },
      { 4, 1, 3 } };
    for (const EulerGrid& grid : { whole, part })
    {
      const Scene plain = with_images(scene, tilted, grid, 3);
      ASSERT_GT(plain.particles.size(), 10U);
      for (const CellWeights weights :
        { CellWeights::Centre, CellWeights::Overlap, CellWeights::Kernel })
      {
        const EulerAverageRequest request = request_of_contacts(grid, weights);
        const EulerAverages found = average_contacts_of(scene, &box, request);
        EXPECT_LT(error_of(found, average_contacts_of(plain, nullptr, request)), 1e-12);
      }
    }
  }
}

TEST(TiltedImages, PointsHaveWhatEachImageAsAParticleGivesThem)
{
  unsigned seed = 20;
  for (const Tilted& tilted : boxes)
  {
    const Scene scene = scene_in(tilted, ++seed);
    const Box box = tilted.box();
    const EulerGrid grid = bounds_of(tilted, { 1, 1, 1 });
    const Scene plain = with_images(scene, tilted, grid, 4);
    const std::vector<double> points = random_points(60, grid.lo, grid.hi, seed, 0.1);
    for (const KernelShape shape : { KernelShape::Gaussian, KernelShape::Heaviside })
    {
      const PointAverageRequest request = request_at_points(shape, 0.3);
      EXPECT_LT(error_of(average_points_of(scene, points, &box, request),
                  average_points_of(plain, points, nullptr, request)),
        1e-12);
    }
  }
}

/// A grid that is no longer than the lengths of the box divides space as the box does.
TEST(TiltedImages, AGridAsLargeAsTheBoxHasEachParticleOnce)
{
  for (const Vector3& tilts : { Vector3{ 0.5, -0.25, 1 }, { 1, 1, 0 }, { 2, -3, 0.5 } })
  {
    const Tilted tilted = { "pp pp pp", { -1, 0, 2 },
      { { { 2, 0, 0 }, { tilts[0], 4, 0 }, { tilts[1], tilts[2], 1 } } } };
    const Box box = tilted.box();
    std::vector<Particle> particles;
    for (int i = 0; i < 125; ++i)
    {
      const Vector3 parts = { i % 5 * 0.5, i / 5 % 5 * 0.5, i / 25 * 0.5 };
      particles.push_back({ tilted.at(parts, tilted.origin), {}, 0.1, 1 });
    }
    const Grains arrays(particles);
    for (const std::array<std::int64_t, 3>& counts :
      { std::array<std::int64_t, 3>{ 1, 1, 1 }, { 2, 4, 3 }, { 30, 40, 20 } })
    {
      const EulerGrid grid = { tilted.origin, { 1, 4, 3 }, counts };
      for (const CellWeights weights : { CellWeights::Centre, CellWeights::Overlap })
      {
        const EulerAverages averages = average(arrays.frame(&box), request_for(grid, weights));
        BigSum volume;
        for (const double fraction : averages.cells.volume_fraction)
        {
          volume.add(fraction * 8 / static_cast<double>(grid.size()));
        }
        const double found = volume.value() / sphere_volume(0.1);
        EXPECT_NEAR(found, 125, 1e-10) << tilts[0] << " " << grid.size();
        EXPECT_EQ(averages.outside, 0);
      }
    }
  }
}

TEST(TiltedImages, KernelsAreNotBoundedAlongPeriodicAxes)
{
  const Tilted& tilted = boxes[0];
  const Scene scene = scene_in(tilted, 40);
  const Box box = tilted.box();
  const EulerGrid grid = bounds_of(tilted, { 5, 4, 6 });
  const auto found = [&](KernelBounds bounds)
  {
    return average_contacts_of(
      scene, &box, request_of_contacts(grid, CellWeights::Kernel, KernelShape::Lucy, 0.3, bounds));
  };
  EXPECT_EQ(error_of(found(KernelBounds::Inside), found(KernelBounds::None)), 0);
}

/// A particle 2^50 periods away along z is moved along x and y, too: by whole periods of these here.
TEST(TiltedImages, ParticlesFarAwayComeBackAndFarGridsAreRefused)
{
  const Tilted tilted = { "pp pp pp", { 0, 0, 0 }, { { { 2, 0, 0 }, { 1, 3, 0 }, { 2, 3, 1 } } } };
  const Box box = tilted.box();
  const EulerGrid grid = { { 0, 0, 0 }, { 2, 3, 1 }, { 2, 1, 1 } };
  const Grains particles({ { { 0.5, 1, 0x1p50 }, {}, 0.1, 1 } }); // 2^50 c are 2^50 b and 2^49 a
  const EulerCells cells =
    average(particles.frame(&box), request_for(grid, CellWeights::Centre)).cells;
  EXPECT_EQ(cells.volume_fraction[0], sphere_volume(0.1) / 3);
  EXPECT_EQ(cells.volume_fraction[1], 0);
  const EulerGrid far = { { 1e30, 0, 0 }, { 2e30, 1, 1 }, { 1, 1, 1 } };
  EXPECT_THROW(average(particles.frame(&box), request_for(far, CellWeights::Centre)), LimitError);
}

TEST(TiltedImages, GeneralBoxesHaveNone)
{
  const Tilted general = { "pp pp pp", { 0, 0, 0 },
    { { { 1, 1, 0.2 }, { -1, 1.2, 0 }, { 0.1, 0.3, 1.3 } } } };
  const Scene scene = scene_in(general, 50);
  const Box box = general.box();
  const EulerAverageRequest request =
    request_of_contacts(bounds_of(general, { 5, 4, 6 }), CellWeights::Overlap);
  EXPECT_EQ(error_of(average_contacts_of(scene, &box, request),
              average_contacts_of(scene, nullptr, request)),
    0);
}
