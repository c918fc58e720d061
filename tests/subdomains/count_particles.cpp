// SPDX-License-Identifier: BSD-3-Clause
// Particles in grids and in other subdomains, against every particle compared with every face.
#include "granular/subdomains/count_particles.h"
#include "../grid/made_subdomains.h"
#include "../support/error_of.h"
#include "../support/exact_units.h"
#include "../support/hard_case.h"
#include "counted_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

using namespace granular;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

ProcessGrid grid_of(const Vector3& lo, const Vector3& hi, const std::array<int, 3>& counts)
{
  return make_process_grid({ lo, hi, 0, counts, {} });
}

/// Random lengths, places and cuts, some of which coincide.
ProcessGrid random_grid(std::mt19937_64& random)
{
  const double scales[] = { 1e-300, 1e-9, 0.7, 1, 1e9 };
  ProcessGrid grid;
  for (std::vector<double>& cuts : grid.cuts)
  {
    const double scale = scales[random() % std::size(scales)];
    const double lo = scale * (std::generate_canonical<double, 53>(random) - 0.5);
    const double cluster = random() % 2 == 0 ? 1 : 1e-8; // nearly all in one place
    cuts.resize(2 + random() % 12);
    std::ranges::generate(
      cuts, [&] { return lo + scale * cluster * std::generate_canonical<double, 53>(random); });
    cuts.push_back(lo + scale);
    cuts.push_back(cuts[random() % cuts.size()]);
    std::ranges::sort(cuts);
  }
  return grid;
}

Points points_around(const ProcessGrid& grid, std::size_t count, std::mt19937_64& random)
{
  const auto& [x, y, z] = grid.cuts;
  return chosen_points(count, { beside(x), beside(y), beside(z) },
    { x.front(), y.front(), z.front() }, { x.back(), y.back(), z.back() }, random);
}

/// Counts points that were put into subdomains chosen by chance, each below the upper faces of its own.
void expect_chosen_counts(const Subdomains& subdomains, int count_of_points)
{
  std::mt19937_64 random(13);
  Points points;
  std::vector<std::int64_t> expected(subdomains.size());
  for (int i = 0; i < count_of_points; ++i)
  {
    const std::size_t number = random() % subdomains.size();
    const Subdomain& subdomain = subdomains[number];
    Vector3 x;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double part = random() % 4 == 0 ? 0 : std::generate_canonical<double, 53>(random);
      x[axis] = std::min(subdomain.lo[axis] + part * (subdomain.hi[axis] - subdomain.lo[axis]),
        std::nextafter(subdomain.hi[axis], -1.0));
    }
    points.push_back(x);
    ++expected[number];
  }
  const ParticleCounts counts = count(frame_of(points), subdomains, 2);
  EXPECT_TRUE(counts.particles == expected);
  EXPECT_EQ(counts.outside, 0);
}

std::int64_t sum_of(const ParticleCounts& counts)
{
  return std::accumulate(counts.particles.begin(), counts.particles.end(), counts.outside);
}
}

TEST(CountInGrid, FacesBelongToTheSubdomainAboveAndTheLastToTheOneBelow)
{
  const ProcessGrid grid = grid_of({ 0, 0, 0 }, { 2, 1, 1 }, { 2, 1, 1 });
  const auto count_at = [&](double x) { return count(frame_of({ { x, 0.5, 1 } }), grid); };
  EXPECT_EQ(count_at(0), (ParticleCounts{ { 1, 0 }, 0 }));
  EXPECT_EQ(count_at(-0.0), (ParticleCounts{ { 1, 0 }, 0 }));
  EXPECT_EQ(count_at(std::nextafter(1, 0)), (ParticleCounts{ { 1, 0 }, 0 }));
  EXPECT_EQ(count_at(1), (ParticleCounts{ { 0, 1 }, 0 }));
  EXPECT_EQ(count_at(2), (ParticleCounts{ { 0, 1 }, 0 }));
  for (const double x :
    { std::nextafter(2, 3), -5e-324, -1.0, 1e300, no_number, infinity, -infinity })
  {
    EXPECT_EQ(count_at(x), (ParticleCounts{ { 0, 0 }, 1 })) << x;
  }
}

TEST(CountInGrid, NoPlaceAlongOneAxisIsOutside)
{
  const ProcessGrid grid = grid_of({ -1, -1, -1 }, { 1, 1, 1 }, { 3, 3, 3 });
  for (const double wrong : { no_number, infinity, -infinity, 2.0, -2.0 })
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      Vector3 point = {};
      point[axis] = wrong;
      EXPECT_EQ(count(frame_of({ point }), grid).outside, 1);
    }
  }
}

TEST(CountInGrid, MinusZeroIsZero)
{
  ProcessGrid grid;
  grid.cuts = { { { -1, -0.0, 1 }, { -0.0, 1 }, { -1, 0.0 } } };
  EXPECT_EQ(count(frame_of({ { 0.0, 0.0, -0.0 }, { -0.0, -0.0, 0.0 } }), grid),
    (ParticleCounts{ { 0, 2 }, 0 }));
}

/// Particles within three ulps of images of cuts, compared with the cuts as integers of 128 bits.
TEST(CountInGrid, ImagesAreInTheSubdomainThatHasThem)
{
  std::mt19937_64 random(8);
  for (const auto& [lo, hi] :
    { std::array{ 0., 0.1 }, std::array{ -0.3, 0.7 }, std::array{ 1., 1000.1 } })
  {
    const ProcessGrid grid = grid_of({ lo, 0, 0 }, { hi, 1, 1 }, { 4, 1, 1 });
    const std::vector<double>& cuts = grid.cuts[0];
    Points points;
    std::vector<std::int64_t> expected(4);
    for (int i = 0; i < 50000; ++i)
    {
      const double periods = static_cast<double>(random() % 20001) - 10000;
      double x = cuts[random() % cuts.size()] + periods * (hi - lo);
      for (std::uint64_t ulps = random() % 4, up = random() % 2; ulps > 0; --ulps)
      {
        x = std::nextafter(x, up == 0 ? -infinity : infinity);
      }
      x = std::abs(x) < 0x1p-20 ? 0 : x; // a whole number of units
      points.push_back({ x, 0.5, 0.5 });
      const Int128 image = image_in(x, lo, hi);
      const auto behind = std::find_if(
        cuts.begin() + 1, cuts.end(), [image](double cut) { return to_units(cut) > image; });
      ++expected[static_cast<std::size_t>(behind - cuts.begin() - 1)];
    }
    FrameView frame = frame_of(points);
    frame.has_box = true;
    frame.header.box = Box::from_bounds({ lo, 0, 0 }, { hi, 1, 1 });
    frame.header.box.boundary = "pp ff ff";
    EXPECT_EQ(count(frame, grid), (ParticleCounts{ expected, 0 })) << lo << " " << hi;
    EXPECT_EQ(count(frame, grid.subdomains(0, 4)), (ParticleCounts{ expected, 0 }));
  }
}

TEST(CountInGrid, TheExampleWithSevenPeriods)
{
  const Points points = { { -0.7000000000000001, 0.5, 0.5 } };
  FrameView frame = frame_of(points);
  frame.has_box = true;
  frame.header.box = Box::from_bounds({ 0, 0, 0 }, { 0.1, 1, 1 });
  frame.header.box.boundary = "pp pp pp";
  EXPECT_EQ(count(frame, grid_of({ 0, 0, 0 }, { 0.1, 1, 1 }, { 4, 1, 1 })),
    (ParticleCounts{ { 0, 0, 0, 1 }, 0 }));
}

/// Each cut, and one ulp beside it.
TEST(CountInGrid, RandomGridsAgreeWithComparisons)
{
  HardCase hard("counts on faces",
    "particles on and one ulp beside the faces of 300 grids: grids with other counts than by "
    "comparison",
    "grids", 0);
  std::mt19937_64 random(4);
  for (int turn = 0; turn < 300; ++turn)
  {
    const ProcessGrid grid = random_grid(random);
    const Points points = points_around(grid, 500, random);
    const ParticleCounts counts = count(frame_of(points), grid);
    hard.add(counts == count_by_cuts(points, grid) ? 0 : 1, 500);
    ASSERT_EQ(counts, count_by_cuts(points, grid)) << turn;
    ASSERT_EQ(counts, count_one_by_one(points, grid.subdomains(0, grid.size()))) << turn;
    ASSERT_EQ(sum_of(counts), 500);
  }
}

TEST(CountInGrid, EvenGridsAgreeWithComparisons)
{
  std::mt19937_64 random(5);
  const double ulp = std::nextafter(1e9, 2e9);
  struct Interval
  {
    double lo;
    double hi;
  };
  const Interval intervals[] = { { 0.1, 0.7 }, { 1e9, 1e9 + 1e-6 * 64 }, { 1e9, ulp }, { 1e9, 1e9 },
    { -1e300, 1e300 }, { -8e307, 8e307 }, { 0, 5e-324 }, { -3e-320, 3e-320 }, { -1e-310, 1e-307 },
    { std::nextafter(-1, 0), -0.0 } };
  for (const auto& [lo, hi] : intervals)
  {
    for (const int p : { 1, 2, 3, 4, 7, 64, 1000 })
    {
      const ProcessGrid grid = grid_of({ lo, 0, 0 }, { hi, 1, 1 }, { p, 1, 2 });
      const Points points = points_around(grid, 1000, random);
      ASSERT_EQ(count(frame_of(points), grid), count_by_cuts(points, grid))
        << lo << ' ' << hi << ' ' << p;
    }
  }
}

/// Two numbers in four slabs: cuts coincide, and the last slab that begins at a cut has what lies on it.
TEST(CountInGrid, SlabOfOneUlp)
{
  const double hi = std::nextafter(1e9, 2e9);
  const ProcessGrid grid = grid_of({ 1e9, 0, 0 }, { hi, 1, 1 }, { 4, 1, 1 });
  EXPECT_EQ(grid.cuts[0], (std::vector{ 1e9, 1e9, 1e9, hi, hi }));
  const Points points = { { 1e9, 0, 0 }, { 1e9, 0.5, 1 }, { hi, 0, 0 } };
  const ParticleCounts counts = count(frame_of(points), grid);
  EXPECT_EQ(counts, (ParticleCounts{ { 0, 0, 2, 1 }, 0 }));
  EXPECT_EQ(count(frame_of(points), grid.subdomains(0, 4)), counts);
}

TEST(CountInGrid, AllInOneOfMillionAndNobodyInTheOthers)
{
  const ProcessGrid grid = grid_of({ 0, 0, 0 }, { 1, 1, 1 }, { 100, 100, 100 });
  const ParticleCounts counts = count(frame_of(Points(100'000, { 0.999, 0.005, 0.015 })), grid, 2);
  ASSERT_EQ(counts.particles.size(), 1'000'000u);
  EXPECT_EQ(counts.particles[(99 * 100 + 0) * 100 + 1], 100'000);
  EXPECT_EQ(sum_of(counts), 100'000);
}

TEST(CountInGrid, MillionSlabsInAnyPlaces)
{
  std::mt19937_64 random(7);
  ProcessGrid grid = grid_of({ 0, 0, 0 }, { 1, 1, 1 }, { 1'000'000, 1, 1 });
  for (std::size_t i = 1; i < 1'000'000; ++i)
  {
    grid.cuts[0][i] = std::pow(grid.cuts[0][i], 40); // half of them below 1e-12
  }
  std::vector<double> cuts(grid.cuts[0].begin() + 1, grid.cuts[0].end() - 1);
  const Points points = points_around({ { beside(cuts), { 0, 1 }, { 0, 1 } } }, 200'000, random);
  const ParticleCounts counts = count(frame_of(points), grid);
  std::vector<std::int64_t> expected(1'000'000);
  std::int64_t outside = 0;
  for (const auto& [x, y, z] : points)
  {
    const bool inside = 0 <= x && x <= 1 && 0 <= y && y <= 1 && 0 <= z && z <= 1;
    ++(inside ? expected[static_cast<std::size_t>(std::ranges::upper_bound(cuts, x) - cuts.begin())]
              : outside);
  }
  EXPECT_TRUE(counts.particles == expected);
  EXPECT_EQ(counts.outside, outside);
}

TEST(CountInGrid, RefusesCutsThatAreNone)
{
  const auto error_of = [](std::vector<double> cuts)
  {
    ProcessGrid grid{ { { { 0, 1 }, std::move(cuts), { 0, 1 } } } };
    return ::error_of([&] { count(frame_of({}), grid); });
  };
  const std::string expected = "expected finite cuts along y, none below the one before";
  EXPECT_EQ(error_of({ 0, 2, 1 }), expected);
  EXPECT_EQ(error_of({ 0, no_number, 2 }), expected);
  EXPECT_EQ(error_of({ 0, infinity }), expected);
  EXPECT_EQ(error_of({ 0, 0 }), "");
}

TEST(CountInGrid, GridWithoutSubdomainsHasAllOutside)
{
  EXPECT_EQ(count(frame_of({ { 0, 0, 0 } }), ProcessGrid{}), (ParticleCounts{ {}, 1 }));
  EXPECT_EQ(count(frame_of({ { 0, 0, 0 } }), Subdomains{}), (ParticleCounts{ {}, 1 }));
}

TEST(CountInSubdomains, ShuffledGridsAreCountedInTheirOrder)
{
  std::mt19937_64 random(8);
  for (int turn = 0; turn < 100; ++turn)
  {
    const ProcessGrid grid = random_grid(random);
    Subdomains subdomains = grid.subdomains(0, grid.size());
    std::ranges::shuffle(subdomains, random);
    const Points points = points_around(grid, 300, random);
    const ParticleCounts counts = count(frame_of(points), subdomains);
    const ParticleCounts expected = count_one_by_one(points, subdomains);
    ASSERT_EQ(counts, expected) << turn;
  }
}

TEST(CountInSubdomains, BisectionsAgreeWithComparisons)
{
  std::mt19937_64 random(9);
  for (const int size : { 2, 3, 5, 8, 17, 100, 300 })
  {
    for (unsigned seed = 0; seed < 10; ++seed)
    {
      Subdomains subdomains = made_bisection(size, seed);
      std::array<std::vector<double>, 3> faces;
      for (const Subdomain& subdomain : subdomains)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          faces[axis].insert(faces[axis].end(), { subdomain.lo[axis], subdomain.hi[axis] });
        }
      }
      for (std::vector<double>& of_axis : faces)
      {
        of_axis = beside(of_axis);
      }
      std::ranges::shuffle(subdomains, random);
      const Points points = chosen_points(2000, faces, { 0, 0, 0 }, { 1, 1, 1 }, random);
      ASSERT_EQ(count(frame_of(points), subdomains), count_one_by_one(points, subdomains))
        << size << ' ' << seed;
    }
  }
}

/// Wheels of sails turn around each other: no plane divides them.
TEST(CountInSubdomains, WhatNoPlaneDivides)
{
  const Subdomains wheel = { made_subdomain({ 0, 0, 0 }, { 2, 1, 1 }),
    made_subdomain({ 2, 0, 0 }, { 3, 2, 1 }), made_subdomain({ 1, 2, 0 }, { 3, 3, 1 }),
    made_subdomain({ 0, 1, 0 }, { 1, 3, 1 }), made_subdomain({ 1, 1, 0 }, { 2, 2, 1 }) };
  Subdomains wheels;
  for (int i = 0; i < 49; ++i)
  {
    for (Subdomain sail : wheel)
    {
      for (Vector3* corner : { &sail.lo, &sail.hi })
      {
        (*corner)[0] += 3 * (i % 7);
        (*corner)[1] += 3 * static_cast<double>(i / 7);
      }
      wheels.push_back(sail);
    }
  }
  std::vector<double> whole(23);
  std::iota(whole.begin(), whole.end(), -0.5);
  std::vector<double> faces(22);
  std::iota(faces.begin(), faces.end(), 0);
  std::mt19937_64 random(10);
  const Points points = chosen_points(
    20'000, { beside(faces), beside(faces), { 0, 0.5, 1 } }, { 0, 0, 0 }, { 21, 21, 1 }, random);
  const ParticleCounts counts = count(frame_of(points), wheels);
  EXPECT_EQ(counts, count_one_by_one(points, wheels));
  const Points centres = { { 1.5, 1.5, 0.5 }, { 1, 1, 0 }, { 2, 2, 1 }, { 21, 21, 1 } };
  const ParticleCounts few = count(frame_of(centres), wheels);
  EXPECT_EQ(few.particles[4], 2); // the middle of the first wheel
  EXPECT_EQ(few.particles[2], 1); // the sail that begins at (1, 2) and has (2, 2)
  EXPECT_EQ(few.particles[5 * 48 + 2], 1);
}

/// Boxes in boxes in boxes, each the corner of the one before: sizes from 1 to 1e-150.
TEST(CountInSubdomains, SizesOfAllMagnitudes)
{
  Subdomains subdomains;
  Vector3 hi = { 1, 1, 1 };
  std::array<std::vector<double>, 3> faces;
  for (int i = 0; i < 1500; ++i)
  {
    const auto axis = static_cast<std::size_t>(i % 3);
    Vector3 lo = {};
    lo[axis] = hi[axis] / 2;
    faces[axis].push_back(lo[axis]);
    subdomains.push_back(made_subdomain(lo, hi));
    hi[axis] = lo[axis];
  }
  subdomains.push_back(made_subdomain({}, hi));
  std::mt19937_64 random(11);
  const Points points = chosen_points(
    5000, { beside(faces[0]), beside(faces[1]), beside(faces[2]) }, {}, { 1, 1, 1 }, random);
  EXPECT_EQ(count(frame_of(points), subdomains), count_one_by_one(points, subdomains));
}

TEST(CountInSubdomains, FlatOnesHaveNothingThatOthersHave)
{
  const double hi = std::nextafter(1, 2);
  Subdomains subdomains = made_bisection(5, 1);
  const auto flat = [](double x) { return made_subdomain({ x, 0, 0 }, { x, 1, 1 }); };
  subdomains.insert(subdomains.end(), { flat(0.5), flat(1), flat(1), flat(0), flat(hi) });
  const Points points = { { 0.5, 0.3, 0.3 }, { 1, 0.3, 0.3 }, { 0, 0.3, 0.3 }, { hi, 0.3, 1 } };
  const ParticleCounts counts = count(frame_of(points), subdomains);
  EXPECT_EQ(counts, count_one_by_one(points, subdomains));
  EXPECT_EQ(counts.particles[5], 0);
  EXPECT_EQ(counts.particles[6], 0);
  EXPECT_EQ(counts.particles[7], 1); // the last of two at x = 1
  EXPECT_EQ(counts.particles[8], 0);
  EXPECT_EQ(counts.particles[9], 1);
}

/// A slab of one ulp cut into so many that most are flat, and equal to others: no grid.
TEST(CountInSubdomains, ManyEqualOnes)
{
  const double hi = std::nextafter(1, 2);
  const ProcessGrid grid = grid_of({ 1, 0, 0 }, { hi, 1, 1 }, { 1001, 1, 1 });
  const Subdomains subdomains = grid.subdomains(0, grid.size());
  ASSERT_FALSE(find_process_grid(subdomains));
  Points points(500, { 1, 0.5, 0.5 });
  points.resize(1000, { hi, 0.5, 0.5 });
  const ParticleCounts counts = count(frame_of(points), subdomains);
  EXPECT_TRUE(counts == count(frame_of(points), grid));
  EXPECT_EQ(counts.outside, 0);
}

TEST(CountInSubdomains, FacesWithoutANeighbourAreClosed)
{
  const Subdomains subdomains = { made_subdomain({ 0, 0, 0 }, { 1, 1, 1 }),
    made_subdomain({ 2, 0, 0 }, { 3, 1, 1 }), made_subdomain({ 3, 0.5, 0 }, { 4, 2, 1 }) };
  const Points points = { { 1, 0.5, 0.5 }, { 1.5, 0.5, 0.5 }, { 3, 0.2, 0.5 }, { 3, 1, 1 },
    { 4, 2, 1 } };
  EXPECT_EQ(count(frame_of(points), subdomains), (ParticleCounts{ { 1, 1, 2 }, 1 }));
}

TEST(CountInSubdomains, WhatIsNoBoxHasNothing)
{
  const Subdomains subdomains = { made_subdomain({ no_number, 0, 0 }, { 1, 1, 1 }),
    made_subdomain({ 1, 0, 0 }, { 0, 1, 1 }), made_subdomain({ 0, 0, 0 }, { infinity, 1, 1 }),
    made_subdomain({ -infinity, -infinity, -infinity }, { 0, infinity, 1 }) };
  const Points points = { { 0.5, 0.5, 0.5 }, { 1e308, 0, 0 }, { -1e308, 1e308, 1 },
    { infinity, 0.5, 0.5 }, { -infinity, 0, 0 }, { no_number, no_number, no_number },
    { 1e308, 1e308, 0 } };
  EXPECT_EQ(count(frame_of(points), subdomains), (ParticleCounts{ { 0, 0, 2, 1 }, 4 }));
}

/// What check_subdomains would complain about is counted once all the same.
TEST(CountInSubdomains, ParticlesInOverlapsAreCountedOnce)
{
  Subdomains subdomains = made_bisection(200, 3);
  for (Subdomain& subdomain : subdomains)
  {
    subdomain.hi[0] += 0.2;
    subdomain.lo[2] -= 0.3;
  }
  for (int i = 0; i < 300; ++i)
  {
    subdomains.push_back(made_subdomain({ 0, 0, 0 }, { 1, 1, 1 + 0.01 * i }));
  }
  std::mt19937_64 random(12);
  const Points points = chosen_points(10'000, {}, { 0, 0, 0 }, { 1, 1, 1 }, random);
  const ParticleCounts counts = count(frame_of(points), subdomains);
  EXPECT_EQ(counts.outside, 0);
  EXPECT_EQ(sum_of(counts), 10'000);
}

/// With so many subdomains comparing each particle with all of them would take minutes.
TEST(CountInSubdomains, MillionSubdomainsOfABisection)
{
  expect_chosen_counts(made_bisection(1'000'000, 2), 200'000);
}

/// A hundred thousand in one of a hundred, and again in the smallest of those, five times: nearly all are tiny.
TEST(CountInSubdomains, NearlyAllAreTiny)
{
  Subdomains subdomains = made_bisection(100, 4);
  for (unsigned seed = 0; seed < 5; ++seed)
  {
    const auto volume = [](const Subdomain& s)
    { return (s.hi[0] - s.lo[0]) * (s.hi[1] - s.lo[1]) * (s.hi[2] - s.lo[2]); };
    const auto smallest = std::ranges::min_element(subdomains, {}, volume);
    const Subdomain whole = *smallest;
    subdomains.erase(smallest);
    for (Subdomain part : made_bisection(100'000, seed))
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const auto place = [&](double x) {
          return x == 1 ? whole.hi[axis] : whole.lo[axis] + x * (whole.hi[axis] - whole.lo[axis]);
        };
        part.lo[axis] = place(part.lo[axis]);
        part.hi[axis] = place(part.hi[axis]);
      }
      subdomains.push_back(part);
    }
  }
  std::erase_if(subdomains,
    [](const Subdomain& s)
    { return s.lo[0] == s.hi[0] || s.lo[1] == s.hi[1] || s.lo[2] == s.hi[2]; });
  ASSERT_GT(subdomains.size(), 300'000u); // what is below an ulp is gone
  expect_chosen_counts(subdomains, 200'000);
}
