// SPDX-License-Identifier: BSD-3-Clause
// What is required of subdomains: that they have bounds, do not overlap and leave no gaps.
#include "granular/grid/subdomains.h"

#include "../support/stop.h"
#include "made_subdomains.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

using namespace granular;

namespace
{
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();

/// What is said, errors and notices alike, or "".
std::string said_of(const Subdomains& subdomains, SubdomainChecks checks = {})
{
  const Where where = { "run.vtk", 7, -1, {} };
  std::string error;
  Notices notices;
  try
  {
    Progress progress;
    check_subdomains(subdomains, checks, where, notices, progress);
  }
  catch (const FormatError& thrown)
  {
    error = thrown.what();
  }
  EXPECT_TRUE(notices.empty());
  return error;
}

/// Two cubes one behind the other.
Subdomains pair_of_cubes()
{
  return { made_subdomain({ 0, 0, 0 }, { 1, 1, 1 }, 0, 0),
    made_subdomain({ 1, 0, 0 }, { 2, 1, 1 }, 0, 1) };
}

/// The beginning of the report on overlaps, by comparing all pairs, or "". Coordinates are whole numbers.
std::string compared_overlaps(const Subdomains& subdomains)
{
  const Subdomain bounds = bounds_of(subdomains);
  std::int64_t pairs = 0;
  std::string first;
  for (std::size_t i = 0; i < subdomains.size(); ++i)
  {
    for (std::size_t j = i + 1; j < subdomains.size(); ++j)
    {
      bool overlap = bounds.lo != bounds.hi;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const Subdomain& a = subdomains[i];
        const Subdomain& b = subdomains[j];
        overlap = overlap &&
          (bounds.lo[axis] == bounds.hi[axis] ||
            std::min(a.hi[axis], b.hi[axis]) > std::max(a.lo[axis], b.lo[axis]));
      }
      if (overlap && pairs++ == 0)
      {
        first = ": processes " + std::to_string(i) + " and " + std::to_string(j) + " share ";
      }
    }
  }
  return pairs == 0 ? ""
                    : "run.vtk:7: expected subdomains that share no more than faces, got " +
      std::to_string(pairs) + (pairs == 1 ? " pair that overlaps" : " pairs that overlap") + first;
}

void expect_compared(const Subdomains& subdomains, const std::string& what)
{
  const std::string expected = compared_overlaps(subdomains);
  EXPECT_EQ(said_of(subdomains, { .gap = Answer::None }).substr(0, expected.size()), expected)
    << what;
}

/// Boxes of whole numbers, so that many faces meet, some of them flat.
Subdomains random_boxes(std::size_t count, int places, int longest, unsigned seed)
{
  std::mt19937 random(seed);
  const auto below = [&](int end)
  { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  Subdomains subdomains(count);
  for (Subdomain& each : subdomains)
  {
    each.rank = static_cast<int>(&each - subdomains.data());
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      each.lo[axis] = below(places);
      each.hi[axis] = each.lo[axis] + below(longest + 1);
    }
  }
  return subdomains;
}
}

TEST(CheckSubdomains, as_by_comparing_all)
{
  for (unsigned seed = 0; seed < 40; ++seed)
  {
    for (const std::size_t count : { 1u, 2u, 70u, 1000u })
    {
      const int places = 3 << seed % 6;
      Subdomains boxes = random_boxes(count, places, 1 + static_cast<int>(seed % 5), seed);
      const std::string what = std::to_string(count) + " boxes, seed " + std::to_string(seed);
      expect_compared(boxes, what);
      for (Subdomain& each : boxes)
      {
        each.lo[1] = each.hi[1] = 7;
      }
      expect_compared(boxes, what + ", flat");
    }
  }
}

TEST(CheckSubdomains, divided_boxes)
{
  for (const int count : { 2, 3, 100, 2000 })
  {
    Subdomains subdomains = made_bisection(count, static_cast<unsigned>(count));
    EXPECT_EQ(said_of(subdomains), "");
    std::shuffle(subdomains.begin(), subdomains.end(), std::mt19937(1));
    EXPECT_EQ(said_of(subdomains), "");
    for (int i = 0; i < count; ++i)
    {
      subdomains[static_cast<std::size_t>(i)].rank = i;
    }
    subdomains.front().hi[1] += 0.1;
    expect_compared(subdomains, "one larger");
  }
}

TEST(CheckSubdomains, grids)
{
  for (const std::array<int, 3>& counts : { std::array{ 1, 1, 1 }, std::array{ 2, 1, 2 },
         std::array{ 3, 7, 11 }, std::array{ 1, 500, 1 } })
  {
    Subdomains subdomains = made_grid(counts);
    EXPECT_EQ(said_of(subdomains), "");
    std::shuffle(subdomains.begin(), subdomains.end(), std::mt19937(2));
    EXPECT_EQ(said_of(subdomains), "");
  }
  EXPECT_EQ(said_of({}), "");
}

TEST(CheckSubdomains, many)
{
  Subdomains grid = made_grid({ 40, 50, 50 });
  Subdomains divided = made_bisection(100'000, 5);
  EXPECT_EQ(said_of(grid), "");
  EXPECT_EQ(said_of(divided), "");
  grid[12345].hi[0] += 1e-3;
  EXPECT_EQ(said_of(grid).substr(0, 108),
    "run.vtk:7: expected subdomains that share no more than faces, got 1 pair that overlaps: "
    "processes 12345 and ");
  divided.erase(divided.begin() + 65432);
  EXPECT_NE(said_of(divided).find("got gaps of "), std::string::npos);
}

TEST(CheckSubdomains, overlaps)
{
  Subdomains cubes = pair_of_cubes();
  EXPECT_EQ(said_of(cubes), "");
  cubes[0].hi[0] = std::nextafter(1, 2); // an ulp is within the tolerance
  EXPECT_EQ(said_of(cubes), "");
  cubes[0].hi[0] = 1 + 1.9e-9; // of an edge of 2
  EXPECT_EQ(said_of(cubes), "");
  cubes[0].hi[0] = 1.25;
  EXPECT_EQ(said_of(cubes),
    "run.vtk:7: expected subdomains that share no more than faces, got 1 pair that overlaps: "
    "processes 0 and 1 share 0.25 1 1");
  cubes.push_back(made_subdomain({ 0.5, 0.5, 0.5 }, { 1.5, 0.75, 0.75 }, 0, 17));
  EXPECT_EQ(said_of(cubes),
    "run.vtk:7: expected subdomains that share no more than faces, got 3 pairs that overlap: "
    "processes 0 and 1 share 0.25 1 1");
}

TEST(CheckSubdomains, duplicates)
{
  Subdomains cubes = pair_of_cubes();
  cubes.push_back(cubes[1]);
  cubes.back().rank = 5;
  EXPECT_EQ(said_of(cubes),
    "run.vtk:7: expected subdomains that share no more than faces, got 1 pair that overlaps: "
    "processes 1 and 5 share 1 1 1");
  const Subdomains many(10'000, cubes[0]);
  EXPECT_EQ(said_of(many).substr(0, 106),
    "run.vtk:7: expected subdomains that share no more than faces, got at least 1000000 pairs that "
    "overlap: pro");
}

TEST(CheckSubdomains, gaps)
{
  Subdomains cubes = pair_of_cubes();
  cubes[1].lo[0] = 1.5;
  EXPECT_EQ(said_of(cubes),
    "run.vtk:7: expected subdomains that fill the box from 0 0 0 to 2 1 1, got gaps of 0.25 of its "
    "volume");
  cubes[1].lo[0] = std::nextafter(1, 2);
  EXPECT_EQ(said_of(cubes), "");
  Subdomains grid = made_grid({ 3, 3, 3 });
  grid.erase(grid.begin() + 13);
  EXPECT_NE(said_of(grid).find("got gaps of 0.037037037"), std::string::npos) << said_of(grid);
}

/// Grids with flat subdomains in them, one moved, one missing.
TEST(CheckSubdomains, nearly_grids)
{
  Subdomains grid = made_grid({ 3, 4, 5 });
  grid.push_back(made_subdomain({ 0, 0, 1e3 }, { 0, 3, 1004 }, 0, 60)); // empty, across many
  grid.push_back(grid.back());
  EXPECT_EQ(said_of(grid), "");
  grid.back() = made_subdomain({ 2, 0, 1e3 }, { 2, 3, 1004 }, 0, 61); // outside, behind a gap
  EXPECT_NE(said_of(grid).find("to 2 3 1004, got gaps of 0.333333333333333"), std::string::npos);
  grid.resize(60);
  const Subdomains good = grid;
  grid[7].lo[1] -= 1e-8;
  EXPECT_NE(said_of(grid).find("1 pair"), std::string::npos);
  grid = good;
  grid[7] = grid[8];
  EXPECT_NE(said_of(grid).find("processes 8 and 8 share"), std::string::npos);
  grid = good;
  grid.erase(grid.begin() + 7);
  EXPECT_NE(said_of(grid).find("got gaps of 0.01666666666666"), std::string::npos);
}

/// Tells how far it is, and can be stopped.
TEST(CheckSubdomains, progress)
{
  Notices notices;
  const Subdomains divided = made_bisection(200'000, 3);
  Stop all;
  check_subdomains(divided, {}, {}, notices, all);
  EXPECT_GT(all.reports, 20);
  EXPECT_GT(all.last, 0.9);
  for (const int stop : { 1, all.reports / 2, all.reports })
  {
    Stop progress(stop - 1);
    EXPECT_THROW(check_subdomains(divided, {}, {}, notices, progress), Cancelled);
    EXPECT_EQ(progress.reports, stop);
  }
}

/// An overlap and a gap of the same size do not make up for each other.
TEST(CheckSubdomains, overlap_and_gap)
{
  Subdomains grid = made_grid({ 4, 1, 1 });
  grid[3].lo[0] = grid[2].lo[0];
  grid[3].hi[0] = grid[2].hi[0];
  EXPECT_NE(said_of(grid).find("processes 2 and 3 share 0.5 3 4"), std::string::npos);
  SubdomainChecks lenient;
  lenient.overlap = Answer::None;
  EXPECT_EQ(said_of(grid, lenient), ""); // gaps are looked for only where no two overlap
}

TEST(CheckSubdomains, bounds)
{
  Subdomains cubes = pair_of_cubes();
  cubes[1].lo[2] = no_number;
  EXPECT_EQ(said_of(cubes),
    "run.vtk:7: expected finite bounds, lower ones not above upper ones, got 1 subdomain without: "
    "process 1 from 1 0 nan to 2 1 1");
  cubes[0].hi[0] = infinity;
  cubes.push_back(made_subdomain({ 3, 0, 0 }, { 2, 1, 1 }, 0, 9));
  EXPECT_EQ(said_of(cubes),
    "run.vtk:7: expected finite bounds, lower ones not above upper ones, got 3 subdomains without: "
    "process 0 from 0 0 0 to inf 1 1, process 1 from 1 0 nan to 2 1 1");
}

TEST(CheckSubdomains, notices)
{
  Subdomains cubes = pair_of_cubes();
  cubes.push_back(cubes[0]);
  const SubdomainChecks checks = { Answer::Notice, Answer::Notice };
  Notices notices;
  Progress progress;
  check_subdomains(cubes, checks, { "run.vtk" }, notices, progress);
  ASSERT_EQ(notices.size(), 1);
  EXPECT_EQ(to_string(notices[0]),
    "run.vtk: expected subdomains that share no more than faces, got 1 pair that overlaps: "
    "processes 0 and 0 share 1 1 1");
  cubes.resize(1);
  cubes.push_back(made_subdomain({ 3, 0, 0 }, { 4, 1, 1 }));
  check_subdomains(cubes, checks, {}, notices, progress);
  ASSERT_EQ(notices.size(), 2);
  EXPECT_EQ(to_string(notices[1]),
    "expected subdomains that fill the box from 0 0 0 to 4 1 1, got gaps of 0.5 of its volume");
}

/// Boxes where doubles are few: a small box far away, the largest and the smallest numbers.
TEST(CheckSubdomains, extremes)
{
  Subdomains far;
  double cut = 1e9;
  for (int i = 0; i < 100; ++i)
  {
    const double end = std::nextafter(cut, infinity);
    far.push_back(made_subdomain({ cut, 1e9, -1e9 }, { end, 1e9 + 1e-6, -1e9 + 1 }, 0, i));
    cut = end;
  }
  EXPECT_EQ(said_of(far), "");
  far[50].hi[0] = far[51].hi[0];
  EXPECT_NE(said_of(far).find("processes 50 and 51 share"), std::string::npos);

  const Subdomains all = { made_subdomain({ -largest, -largest, 0 }, { 0, largest, largest }),
    made_subdomain({ 0, -largest, 0 }, { largest, largest, largest }) };
  EXPECT_EQ(said_of(all), "");
  EXPECT_NE(said_of({ all[0], all[0] }).find("1 pair"), std::string::npos);
  const double tiny = std::numeric_limits<double>::denorm_min();
  const Subdomains least = { made_subdomain({ 0, 0, 0 }, { tiny, tiny, tiny }),
    made_subdomain({ 0, 0, tiny }, { tiny, tiny, 2 * tiny }) };
  EXPECT_EQ(said_of(least), "");
  EXPECT_NE(said_of({ least[0], least[0] }).find("1 pair"), std::string::npos);
}

/// A flat box has no volume, but an area that two may share.
TEST(CheckSubdomains, flat)
{
  Subdomains flat = { made_subdomain({ 0, 0, 5 }, { 1, 1, 5 }),
    made_subdomain({ 3, 0, 5 }, { 4, 1, 5 }) };
  EXPECT_EQ(said_of(flat), "");
  flat[1].lo[0] = 0.5;
  EXPECT_NE(said_of(flat).find("share 0.5 1 0"), std::string::npos);
  const Subdomains points(3, made_subdomain({ 1, 2, 3 }, { 1, 2, 3 }));
  EXPECT_EQ(said_of(points), "");
  // within a box that is not flat an empty one is in nobody's way
  Subdomains cubes = pair_of_cubes();
  cubes.push_back(made_subdomain({ 0.5, 0, 0 }, { 0.5, 1, 1 }));
  EXPECT_EQ(said_of(cubes), "");
}

/// Rods along all axes, each through the middle of the others' bounds: none overlaps, no plane divides them.
TEST(CheckSubdomains, woven_rods)
{
  Subdomains rods;
  constexpr int side = 60;
  for (int i = 0; i < side; ++i)
  {
    for (int j = 0; j < side; ++j)
    {
      const double u = 4 * i;
      const double v = 4 * j;
      rods.push_back(made_subdomain({ 0, u, v }, { 4 * side, u + 1, v + 1 }));
      rods.push_back(made_subdomain({ v + 2, 0, u + 2 }, { v + 3, 4 * side, u + 3 }));
      rods.push_back(made_subdomain({ u, v + 2, 0 }, { u + 1, v + 3, 4 * side }));
    }
  }
  EXPECT_EQ(said_of(rods, { .gap = Answer::None }), "");
}
