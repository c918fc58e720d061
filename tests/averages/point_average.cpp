// SPDX-License-Identifier: BSD-3-Clause
// Averages at points, against plain sums with 113 bits over all particles and contacts.
#include "exact_parts.h"
#include "made_points.h"

#include "../support/hard_case.h"
#include "../support/quad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace granular;

namespace
{
constexpr Vector3 lo = { -1, 0, 2 };
constexpr Vector3 hi = { 1, 3, 3 };
constexpr std::size_t axes[6][2] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0, 1 }, { 0, 2 }, { 1, 2 } };

/// The sums at a point, over the volume of the kernel.
struct PlainSums
{
  Quad share = 0, mass = 0, radius = 0, volume = 0, ends = 0, contacts = 0;
  std::array<Quad, 3> momentum = {};
  std::array<Quad, 6> fluctuations = {}, stress = {}, normals = {};
};

/// Calls take(shift) for the images of a box that may be near.
template <class Take>
void each_shift(const std::array<bool, 3>& periodic, const Take& take)
{
  const auto images = [&](std::size_t axis) { return periodic[axis] ? 2 : 0; };
  for (int i = -images(0); i <= images(0); ++i)
  {
    for (int j = -images(1); j <= images(1); ++j)
    {
      for (int k = -images(2); k <= images(2); ++k)
      {
        take(QuadVector{
          i * (Quad(hi[0]) - lo[0]), j * (Quad(hi[1]) - lo[1]), k * (Quad(hi[2]) - lo[2]) });
      }
    }
  }
}

QuadVector seen_from(const Vector3& place, const QuadVector& shift, const Vector3& point)
{
  return { point[0] - (place[0] + shift[0]), point[1] - (place[1] + shift[1]),
    point[2] - (place[2] + shift[2]) };
}

struct PlainAverage
{
  const Scene& scene;
  KernelShape shape;
  double width;
  std::array<bool, 3> periodic;

  template <class Add>
  void each_particle(const Vector3& point, const Add& add) const
  {
    const Quad volume = Kernel(shape, width).volume();
    for (const Particle& particle : scene.particles)
    {
      each_shift(periodic,
        [&](const QuadVector& shift)
        {
          const QuadVector r = seen_from(particle.x, shift, point);
          const Quad square = product_of(r, r);
          if (square < 9 * width * width)
          {
            add(particle, exact_value(shape, width, square) / volume);
          }
        });
    }
  }

  void add_line(const Touch& touch, bool wall, const Vector3& point, PlainSums& sums) const
  {
    const QuadVector b = to_quad(branch_of(touch));
    const Quad square = product_of(b, b);
    each_shift(periodic,
      [&](const QuadVector& shift)
      {
        const QuadVector r = seen_from(touch.from, shift, point);
        if (product_of(r, r) > 2 * (square + 9 * Quad(width) * width))
        {
          return;
        }
        const Quad w = exact_line_mean(shape, width, r, b) / Kernel(shape, width).volume();
        sums.ends += w * (wall ? 1 : 2);
        sums.contacts += w;
        for (std::size_t n = 0; n < 6; ++n)
        {
          const auto [i, j] = axes[n];
          sums.stress[n] += w * (wall ? -1 : 1) * b[i] * touch.force[j];
          sums.normals[n] += w * b[i] * b[j] / square;
        }
      });
  }

  PlainSums at(const Vector3& point) const
  {
    PlainSums sums;
    this->each_particle(point,
      [&](const Particle& particle, Quad w)
      {
        sums.share += w;
        sums.mass += w * particle.mass;
        sums.radius += w * particle.radius;
        sums.volume += w * sphere_volume(particle.radius);
        for (std::size_t k = 0; k < 3; ++k)
        {
          sums.momentum[k] += w * particle.mass * particle.v[k];
        }
      });
    this->each_particle(point,
      [&](const Particle& particle, Quad w)
      {
        for (std::size_t n = 0; w > 0 && n < 6; ++n)
        {
          const auto [i, j] = axes[n];
          sums.fluctuations[n] -= w * particle.mass *
            (particle.v[i] - sums.momentum[i] / sums.mass) *
            (particle.v[j] - sums.momentum[j] / sums.mass);
        }
      });
    for (const Touch& touch : scene.pairs)
    {
      this->add_line(touch, false, point, sums);
    }
    for (const Touch& touch : scene.walls)
    {
      this->add_line(touch, true, point, sums);
    }
    return sums;
  }
};

double ratio(Quad above, Quad below)
{
  return below > 0 ? static_cast<double>(above / below) : 0;
}

/// What the sums make of a point, in the order of values_at.
std::vector<double> expected_at(const PlainSums& sums)
{
  std::vector<double> values = { static_cast<double>(sums.mass), static_cast<double>(sums.volume),
    ratio(sums.radius, sums.share), ratio(sums.ends, sums.share) };
  Quad trace = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    values.push_back(static_cast<double>(sums.momentum[k]));
    values.push_back(ratio(sums.momentum[k], sums.mass));
    trace -= sums.fluctuations[k];
  }
  values.push_back(static_cast<double>(trace / 3));
  values.push_back(ratio(trace, 3 * sums.mass));
  for (std::size_t n = 0; n < 6; ++n)
  {
    values.push_back(static_cast<double>(sums.fluctuations[n]));
    values.push_back(static_cast<double>(sums.stress[n]));
    values.push_back(ratio(sums.normals[n], sums.contacts));
  }
  return values;
}

std::vector<double> values_at(const EulerAverages& averages, std::size_t i)
{
  const EulerCells& cells = averages.cells;
  const EulerFields& fields = averages.fields;
  std::vector<double> values = { fields.density[i], cells.volume_fraction[i], cells.radius[i],
    fields.coordination[i] };
  for (std::size_t k = 0; k < 3; ++k)
  {
    values.push_back(fields.momentum[3 * i + k]);
    values.push_back(cells.velocities[3 * i + k]);
  }
  values.push_back(cells.pressure[i]);
  values.push_back(fields.temperature[i]);
  for (std::size_t n = 0; n < 6; ++n)
  {
    const std::size_t at = 3 * i + n % 3;
    values.push_back(n < 3 ? cells.normal_stress[at] : cells.shear_stress[at]);
    values.push_back(n < 3 ? fields.contact_normal[at] : fields.contact_shear[at]);
    values.push_back(fields.fabric[6 * i + n]);
  }
  return values;
}
}

TEST(PointAverage, IsThatOfPlainSums)
{
  HardCase hard("point averages",
    "all fields at points, also of periodic images, against 113 bits: error of the largest value",
    "1", 1e-13);
  const Scene open = random_scene(150, 60, 8, lo, hi, 1);
  const std::vector<double> points = random_points(30, lo, hi, 2, 0.3);
  for (const std::array<bool, 3>& periodic :
    { std::array<bool, 3>{ false, false, false }, { true, false, true } })
  {
    Box box = Box::from_bounds(lo, hi);
    box.boundary = "pp ff pp";
    const Scene scene = periodic[0] ? with_ends(open) : open;
    for (const KernelShape shape : all_shapes)
    {
      for (const double width : { 0.4, 0.28 })
      {
        const EulerAverages found = average_points_of(
          scene, points, periodic[0] ? &box : nullptr, request_at_points(shape, width));
        EXPECT_TRUE(found.cells.centres.empty());
        EXPECT_EQ(found.cells.count(), 30);
        const PlainAverage plain = { scene, shape, width, periodic };
        std::vector<std::vector<double>> expected;
        std::vector<double> largest(30);
        for (std::size_t i = 0; i < points.size() / 3; ++i)
        {
          expected.push_back(
            expected_at(plain.at({ points[3 * i], points[3 * i + 1], points[3 * i + 2] })));
          for (std::size_t n = 0; n < largest.size(); ++n)
          {
            largest[n] = std::max(largest[n], std::abs(expected.back()[n]));
          }
        }
        for (std::size_t i = 0; i < expected.size(); ++i)
        {
          const std::vector<double> values = values_at(found, i);
          ASSERT_EQ(values.size(), largest.size());
          for (std::size_t n = 0; n < values.size(); ++n)
          {
            EXPECT_GT(largest[n], 0);
            hard.add(std::abs(values[n] - expected[i][n]) / largest[n]);
          }
        }
      }
    }
  }
}

namespace
{
/// The sum over a cubic lattice around a particle, times its volume.
double integral_of_density(KernelShape shape, double steps, const Vector3& place)
{
  const double width = 0.1;
  const double step = width / steps;
  const int reach = static_cast<int>(3 * steps) + 2;
  std::vector<double> points;
  for (int k = -reach; k <= reach; ++k)
  {
    for (int j = -reach; j <= reach; ++j)
    {
      for (int i = -reach; i <= reach; ++i)
      {
        points.insert(points.end(), { i * step, j * step, k * step });
      }
    }
  }
  Scene scene;
  scene.particles = { { place, { 1, -2, 0.5 }, 0.05, 7 } };
  scene.ids = { 1 };
  const EulerAverages found =
    average_points_of(scene, points, nullptr, request_at_points(shape, width), 2);
  Quad mass = 0;
  Quad momentum = 0;
  Quad volume = 0;
  for (std::size_t i = 0; i < found.fields.density.size(); ++i)
  {
    mass += Quad(found.fields.density[i]) * step * step * step;
    momentum += Quad(found.fields.momentum[3 * i + 1]) * step * step * step;
    volume += Quad(found.cells.volume_fraction[i]) * step * step * step;
  }
  const auto integral = static_cast<double>(mass / 7);
  EXPECT_NEAR(static_cast<double>(momentum / -14) / integral, 1, 1e-14);
  EXPECT_NEAR(static_cast<double>(volume) / sphere_volume(0.05) / integral, 1, 1e-14);
  return integral;
}
}

/// The smoother a kernel is at its edge, the better a sum stands for the integral.
TEST(PointAverage, TheIntegralOfTheDensityIsTheMass)
{
  const Vector3 place = { 0.0031, -0.0017, 0.0042 };
  EXPECT_NEAR(integral_of_density(KernelShape::Lucy, 6, place), 1, 1e-6);
  EXPECT_NEAR(integral_of_density(KernelShape::Lucy, 12, place), 1, 1e-8);
  EXPECT_NEAR(integral_of_density(KernelShape::Gaussian, 6, place), 1, 1e-4);
  EXPECT_NEAR(integral_of_density(KernelShape::Heaviside, 16, place), 1, 3e-3);
}

TEST(PointAverage, AUniformLatticeHasItsVelocityAndNoTemperature)
{
  constexpr double d = 0.1;
  Scene scene;
  for (int i = 0; i < 1000; ++i)
  {
    scene.particles.push_back(
      { { i % 10 * d, i / 10 % 10 * d, i / 100 * d }, { 0.1, -1e7 / 3, 3e-11 }, d / 2, 0.01 });
    scene.ids.push_back(i + 1);
  }
  Box box = Box::from_bounds({ 0, 0, 0 }, { 1, 1, 1 });
  box.boundary = "pp pp pp";
  const std::vector<double> points = random_points(50, { 0, 0, 0 }, { 1, 1, 1 }, 3, 1);
  for (const KernelShape shape : all_shapes)
  {
    const EulerAverages found =
      average_points_of(scene, points, &box, request_at_points(shape, 1.7 * d));
    for (std::size_t i = 0; i < 50; ++i)
    {
      EXPECT_NEAR(found.fields.density[i] / (0.01 / (d * d * d)), 1,
        shape == KernelShape::Heaviside ? 0.2
          : shape == KernelShape::Lucy  ? 2e-3
                                        : 0.02);
      EXPECT_DOUBLE_EQ(found.cells.velocities[3 * i], 0.1);
      EXPECT_DOUBLE_EQ(found.cells.velocities[3 * i + 1], -1e7 / 3);
      EXPECT_DOUBLE_EQ(found.cells.velocities[3 * i + 2], 3e-11);
      EXPECT_EQ(found.fields.temperature[i], 0);
      EXPECT_EQ(found.cells.pressure[i], 0);
      EXPECT_FALSE(std::signbit(found.cells.pressure[i]));
      EXPECT_DOUBLE_EQ(found.cells.radius[i], d / 2);
      EXPECT_EQ(found.fields.coordination[i], 0);
    }
  }
}

/// A particle at the end of the kernel counts by its distance, not by what is sought for all points together.
TEST(PointAverage, OtherPointsChangeNothing)
{
  Scene scene;
  scene.particles.push_back({ { 0.1 + 0.2, 0, 0 }, { 0, 0, 0 }, 1, 1 });
  scene.ids.push_back(1);
  const PointAverageRequest request = request_at_points(KernelShape::Gaussian, 1.93);
  const std::vector<double> alone = { -5.49, 0, 0 };
  const std::vector<double> with_another = { -5.49, 0, 0, 0, 0, 0 };
  EXPECT_EQ(average_points_of(scene, alone, nullptr, request).fields.density[0],
    average_points_of(scene, with_another, nullptr, request).fields.density[0]);
}

/// Sums beyond all numbers are none.
TEST(PointAverage, NumbersThatAreTooLarge)
{
  Scene scene;
  for (int i = 0; i < 3000; ++i)
  {
    scene.particles.push_back({ { 0, 0, 0 }, { i % 2 == 0 ? 1e80 : -1e80, 0, 0 }, 1, 1e80 });
    scene.ids.push_back(i + 1);
  }
  const EulerAverages found =
    average_points_of(scene, { 0, 0, 0 }, nullptr, request_at_points(KernelShape::Gaussian, 1e-30));
  EXPECT_FALSE(std::isfinite(found.cells.pressure[0]));
}
