// SPDX-License-Identifier: BSD-3-Clause
// Grids of processes: those that LAMMPS and LIGGGHTS choose, cuts where they put them, and grids found again.
#include "granular/grid/process_grid.h"
#include "made_subdomains.h"

#include "../support/error_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace granular;

namespace
{
using Counts = std::array<std::int64_t, 3>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

GridRequest unit_cube(std::array<int, 3> grid, std::int64_t processes = 0)
{
  return { { 0, 0, 0 }, { 1, 1, 1 }, processes, grid, {} };
}

std::string error_of(const GridRequest& request)
{
  return ::error_of([&] { make_process_grid(request); });
}
}

/// "N by M by K MPI processor grid", as LAMMPS (29 Sep 2021, Update 2) and LIGGGHTS-PUBLIC 3.8.0 both print it after
/// create_box, with `processors` as given and these bounds. From the twelfth row on several grids have the least area,
/// but for rounding.
TEST(ProcessGrid, IsTheOneThatLammpsAndLiggghtsChoose)
{
  struct Measured
  {
    std::int64_t processes;
    Vector3 lo;
    Vector3 hi;
    std::array<int, 3> given; ///< 0: *
    Counts printed;
  };
  const Measured table[] = {
    { 1, { 0, 0, 0 }, { 1, 1, 1 }, { 0, 0, 0 }, { 1, 1, 1 } },
    { 2, { 0, 0, 0 }, { 1, 1, 1 }, { 0, 0, 0 }, { 1, 1, 2 } },
    { 6, { 0, 0, 0 }, { 1, 1, 1 }, { 0, 0, 0 }, { 1, 2, 3 } },
    { 7, { 0, 0, 0 }, { 1, 1, 1 }, { 0, 0, 0 }, { 1, 1, 7 } },
    { 8, { 0, 0, 0 }, { 0.1, 0.1, 0.1 }, { 0, 0, 0 }, { 2, 2, 2 } },
    { 12, { 0, 0, 0 }, { 1, 2, 3 }, { 0, 0, 0 }, { 1, 3, 4 } },
    { 12, { -0.25, 0, 0.5 }, { 0.75, 2, 1 }, { 0, 0, 0 }, { 2, 6, 1 } },
    { 24, { -0.25, 0, 0.5 }, { 0.75, 2, 1 }, { 0, 0, 0 }, { 2, 6, 2 } },
    { 24, { 0, 0, 0 }, { 4, 2, 1 }, { 0, 0, 0 }, { 4, 3, 2 } },
    { 13, { -1, -2, -3 }, { 5, 2, 1 }, { 0, 0, 0 }, { 13, 1, 1 } },
    { 16, { 0, 0, 0 }, { 1, 1, 0.01 }, { 0, 0, 0 }, { 4, 4, 1 } },
    { 12, { 0, 0, 0 }, { 3, 1, 1 }, { 2, 0, 0 }, { 2, 3, 2 } },
    { 12, { 0, 0, 0 }, { 1, 2, 3 }, { 0, 3, 2 }, { 2, 3, 2 } },
    { 12, { 0, 0, 0 }, { 1, 1, 1 }, { 0, 2, 0 }, { 3, 2, 2 } },
    { 12, { 0, 0, 0 }, { 1, 1, 1 }, { 0, 0, 4 }, { 3, 1, 4 } },
    { 15, { 0, 0, 0 }, { 0.3, 0.3, 0.3 }, { 0, 0, 0 }, { 3, 1, 5 } },
    { 20, { 0, 0, 0 }, { 0.3, 0.3, 0.3 }, { 0, 0, 0 }, { 5, 2, 2 } },
    { 21, { 0, 0, 0 }, { 0.3, 0.3, 0.3 }, { 0, 0, 0 }, { 7, 1, 3 } },
    { 20, { 0, 0, 0 }, { 1, 2, 3 }, { 0, 0, 0 }, { 2, 2, 5 } },
    { 15, { 0, 0, 0 }, { 1.3, 1.3, 2.6 }, { 0, 0, 0 }, { 3, 1, 5 } },
    { 18, { 0, 0, 0 }, { 1.1, 1.1, 2.2 }, { 0, 0, 0 }, { 2, 3, 3 } },
    { 18, { 0, 0, 0 }, { 1.1, 0.2, 1.1 }, { 0, 0, 0 }, { 6, 1, 3 } },
    { 9, { 0, 0, 0 }, { 0.7, 0.9, 0.7 }, { 0, 0, 0 }, { 3, 3, 1 } },
    { 18, { 0, 0, 0 }, { 0.1, 0.3, 0.2 }, { 0, 0, 0 }, { 1, 6, 3 } },
  };
  for (const auto& [processes, lo, hi, given, printed] : table)
  {
    EXPECT_EQ(make_process_grid({ lo, hi, processes, given, {} }).counts(), printed)
      << processes << " in " << hi[0] << ' ' << hi[1] << ' ' << hi[2];
  }
}

/// X_COORDINATES of LIGGGHTS-PUBLIC 3.8.0's dump decomposition/vtk in a box from 100000000000.1 to 200000000000.7 on
/// 3, 7 and 11 processes: so far out six decimals tell every double.
TEST(ProcessGrid, CutsAreThoseOfLiggghtsToTheLastBit)
{
  const std::vector<double> printed[] = {
    { 100000000000.100006, 133333333333.633331, 166666666667.166687, 200000000000.700012 },
    { 100000000000.100006, 114285714285.900009, 128571428571.700012, 142857142857.500000,
      157142857143.299988, 171428571429.100006, 185714285714.900024, 200000000000.700012 },
    { 100000000000.100006, 109090909091.063644, 118181818182.027283, 127272727272.990906,
      136363636363.954559, 145454545454.918182, 154545454545.881836, 163636363636.845459,
      172727272727.809082, 181818181818.772766, 190909090909.736389, 200000000000.700012 },
  };
  for (const std::vector<double>& cuts : printed)
  {
    const int p = static_cast<int>(cuts.size()) - 1;
    const ProcessGrid grid =
      make_process_grid({ { 0, 100000000000.1, 0 }, { 1, 200000000000.7, 1 }, 0, { 1, p, 1 }, {} });
    EXPECT_EQ(grid.cuts[1], cuts);
  }
}

TEST(ProcessGrid, SubdomainsAreNumberedWithZFastest)
{
  GridRequest request = unit_cube({ 2, 3, 0 }, 12);
  request.cuts[0] = { 0.25 };
  const ProcessGrid grid = make_process_grid(request);
  EXPECT_EQ(grid.counts(), (Counts{ 2, 3, 2 }));
  EXPECT_EQ(grid.size(), 12);
  const std::vector<Subdomain> all = grid.subdomains(0, 12);
  ASSERT_EQ(all.size(), 12u);
  EXPECT_EQ(all[0], made_subdomain({ 0, 0, 0 }, { 0.25, 1.0 / 3, 0.5 }));
  EXPECT_EQ(all[1], made_subdomain({ 0, 0, 0.5 }, { 0.25, 1.0 / 3, 1 }, 0, 1));
  EXPECT_EQ(all[2], made_subdomain({ 0, 1.0 / 3, 0 }, { 0.25, 2.0 / 3, 0.5 }, 0, 2));
  EXPECT_EQ(all[6], made_subdomain({ 0.25, 0, 0 }, { 1, 1.0 / 3, 0.5 }, 0, 6));
  EXPECT_EQ(all[11], made_subdomain({ 0.25, 2.0 / 3, 0.5 }, { 1, 1, 1 }, 0, 11));
  EXPECT_EQ(grid.subdomains(4, 9), (std::vector(all.begin() + 4, all.begin() + 9)));
  EXPECT_TRUE(grid.subdomains(3, 3).empty());
  EXPECT_EQ(ProcessGrid{}.size(), 0);
  EXPECT_EQ(ProcessGrid{}.counts(), (Counts{ 0, 0, 0 }));
}

TEST(ProcessGrid, CutsSayHowManyThereAre)
{
  GridRequest request = unit_cube({ 0, 0, 0 }, 12);
  request.cuts[1] = { 0.1, 0.7 };
  EXPECT_EQ(make_process_grid(request).counts(), (Counts{ 2, 3, 2 }));
  EXPECT_EQ(make_process_grid(request).cuts[1], (std::vector<double>{ 0, 0.1, 0.7, 1 }));
  request = unit_cube({ 1, 0, 1 });
  request.cuts[1] = { 0.5 };
  EXPECT_EQ(make_process_grid(request).counts(), (Counts{ 1, 2, 1 }));
}

TEST(ProcessGrid, EvenCutsNeverDecreaseAndEndAtTheBounds)
{
  struct Interval
  {
    double lo;
    double hi;
  };
  const double ulp = std::nextafter(1e9, 2e9);
  const Interval intervals[] = { { 1e9, ulp }, { 1e9, 1e9 }, { 1e9, 1e9 + 1e-3 }, { 0.1, 0.7 },
    { -1, std::nextafter(-1, 0) }, { -1e300, 1e300 }, { 0, 5e-324 }, { -0.0, 0.0 },
    { -1e-310, 3e-310 }, { -8e307, 8e307 } };
  for (const auto& [lo, hi] : intervals)
  {
    for (const int p : { 1, 2, 3, 7, 64, 1000, 99991 })
    {
      const ProcessGrid grid =
        make_process_grid({ { lo, 0, 0 }, { hi, 1, 1 }, 0, { p, 1, 1 }, {} });
      const std::vector<double>& cuts = grid.cuts[0];
      ASSERT_EQ(cuts.size(), static_cast<std::size_t>(p) + 1);
      EXPECT_EQ(cuts.front(), lo);
      EXPECT_EQ(cuts.back(), hi);
      EXPECT_TRUE(std::ranges::is_sorted(cuts)) << lo << ' ' << hi << ' ' << p;
    }
  }
}

TEST(ProcessGrid, ManyProcessesAreDividedInNoTime)
{
  EXPECT_EQ(
    make_process_grid(unit_cube({ 0, 0, 0 }, 1'000'000)).counts(), (Counts{ 100, 100, 100 }));
  EXPECT_EQ(make_process_grid(unit_cube({ 1, 0, 1 }, 999'983)).counts(), // a prime
    (Counts{ 1, 999'983, 1 }));
  EXPECT_EQ(make_process_grid({ { 0, 0, 0 }, { 1, 9, 1 }, 999'983, { 0, 0, 0 }, {} }).counts(),
    (Counts{ 1, 999'983, 1 }));
}

TEST(ProcessGrid, SaysWhatIsWrongWithARequest)
{
  struct Wrong
  {
    GridRequest request;
    std::string text;
  };
  const auto with_cuts = [](std::array<int, 3> grid, std::vector<double> cuts) {
    return GridRequest{ { 0, 0, 0 }, { 1, 1, 1 }, 0, grid, { std::move(cuts), {}, {} } };
  };
  const auto with_bounds = [](double lo, double hi) {
    return GridRequest{ { 0, lo, 0 }, { 1, hi, 1 }, 0, { 1, 1, 1 }, {} };
  };
  const std::string bounds =
    "expected finite bounds along y, the upper one not below the lower one, got ";
  const Wrong table[] = {
    { with_bounds(1, 0), bounds + "1 and 0" },
    { with_bounds(no_number, 0), bounds + "nan and 0" },
    { with_bounds(0, infinity), bounds + "0 and inf" },
    { with_bounds(-1e308, 1e308), bounds + "-1e+308 and 1e+308" },
    { unit_cube({ 1, -2, 1 }),
      "expected a number of processes along y, or 0 to have it chosen, got -2" },
    { unit_cube({ 1, 1, 1 }, -1),
      "expected a number of processes, or 0 for as many as the grid has, got -1" },
    { unit_cube({ 2, 3, 4 }, 23),
      "expected a number of processes that a grid of 2 x 3 x 4 can have, got 23" },
    { unit_cube({ 2, 0, 4 }, 12),
      "expected a number of processes that a grid of 2 x 0 x 4 (0: chosen) can have, got 12" },
    { unit_cube({ 2, 0, 4 }),
      "expected how many processes there are, to choose a grid 2 x 0 x 4 for, got 0" },
    { unit_cube({ 65536, 32768, 1 }),
      "expected fewer than 2^31 processes, got a grid of 65536 x 32768 x 1" },
    { unit_cube({ 2147483647, 2147483647, 2147483647 }),
      "expected fewer than 2^31 processes, got a grid of 2147483647 x 2147483647 x 2147483647" },
    { unit_cube({ 0, 0, 0 }, std::int64_t{ 1 } << 31),
      "expected fewer than 2^31 processes, got 2147483648" },
    { with_cuts({ 2, 1, 1 }, { 0.5, 0.6 }),
      "expected 1 cuts along x for 2 processes, or 0 processes, which follow from "
      "the cuts, got 2" },
    { with_cuts({ 1, 1, 1 }, { 0.5 }),
      "expected 0 cuts along x for 1 processes, or 0 processes, which follow from "
      "the cuts, got 1" },
    { with_cuts({ 3, 1, 1 }, { 0.6, 0.5 }),
      "expected increasing cuts along x between 0 and 1, got 0.5 behind 0.6" },
    { with_cuts({ 3, 1, 1 }, { 0.5, 0.5 }),
      "expected increasing cuts along x between 0 and 1, got 0.5 behind 0.5" },
    { with_cuts({ 2, 1, 1 }, { -0.5 }),
      "expected increasing cuts along x between 0 and 1, got -0.5" },
    { with_cuts({ 2, 1, 1 }, { -0.0 }),
      "expected increasing cuts along x between 0 and 1, got -0" },
    { with_cuts({ 2, 1, 1 }, { 1 }), "expected increasing cuts along x between 0 and 1, got 1" },
    { with_cuts({ 2, 1, 1 }, { no_number }),
      "expected increasing cuts along x between 0 and 1, got nan" },
  };
  for (const auto& [request, text] : table)
  {
    EXPECT_EQ(error_of(request), text);
  }
}

TEST(FindProcessGrid, InWhateverOrder)
{
  GridRequest request = unit_cube({ 3, 0, 4 }, 24);
  request.cuts[0] = { 0.1, 0.11 };
  const ProcessGrid grid = make_process_grid(request);
  std::vector<Subdomain> subdomains = grid.subdomains(0, grid.size());
  std::mt19937 random(1);
  for (int turn = 0; turn < 10; ++turn)
  {
    std::vector<std::int64_t> order;
    const auto found = find_process_grid(subdomains, &order);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->cuts, grid.cuts);
    ASSERT_EQ(order.size(), subdomains.size());
    for (std::size_t i = 0; i < order.size(); ++i)
    {
      EXPECT_EQ(order[i], subdomains[i].rank); // which make_process_grid gave
    }
    std::ranges::shuffle(subdomains, random);
  }
}

TEST(FindProcessGrid, OneAndFlatOnesAreGridsToo)
{
  const std::vector<Subdomain> one = { made_subdomain({ -0.0, 1, 2 }, { 0.0, 1, 3 }) };
  ASSERT_TRUE(find_process_grid(one));
  EXPECT_EQ(find_process_grid(one)->counts(), (Counts{ 1, 1, 1 }));
  const std::vector<Subdomain> flat_between = { made_subdomain({ 1, 0, 0 }, { 1, 1, 1 }),
    made_subdomain({ 1, 0, 0 }, { 2, 1, 1 }), made_subdomain({ 0, 0, 0 }, { 1, 1, 1 }) };
  std::vector<std::int64_t> order;
  const auto found = find_process_grid(flat_between, &order);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->cuts[0], (std::vector<double>{ 0, 1, 1, 2 }));
  EXPECT_EQ(order, (std::vector<std::int64_t>{ 1, 2, 0 }));
}

TEST(FindProcessGrid, WhatIsNoGridIsNone)
{
  const std::vector<Subdomain> grid = made_grid({ 3, 2, 2 });
  ASSERT_TRUE(find_process_grid(grid));
  const auto changed = [&](const auto& change)
  {
    std::vector<Subdomain> other = grid;
    change(other);
    return other;
  };
  const std::vector<Subdomain> table[] = {
    {},
    changed([](auto& s) { s.pop_back(); }),
    changed([](auto& s) { s.push_back(s[0]); }),
    changed([](auto& s) { s[1] = s[0]; }),
    changed([](auto& s) { s[4].hi[0] = std::nextafter(s[4].hi[0], infinity); }),
    changed([](auto& s) { s[4].lo[2] = no_number; }),
    changed([](auto& s) { std::swap(s[4].lo, s[4].hi); }),
    changed([](auto& s) { s.back().hi[1] = infinity; }),
    made_bisection(64, 1),
    // a gap between
    { made_subdomain({ 0, 0, 0 }, { 1, 1, 1 }), made_subdomain({ 2, 0, 0 }, { 3, 1, 1 }) },
    // nothing tells these two from each other
    { made_subdomain({ 0, 0, 0 }, { 0, 1, 1 }), made_subdomain({ 0, 0, 0 }, { 0, 1, 1 }) },
  };
  for (const std::vector<Subdomain>& subdomains : table)
  {
    EXPECT_FALSE(find_process_grid(subdomains)) << &subdomains - table;
  }
}

TEST(FindProcessGrid, MillionSubdomains)
{
  const std::array<int, 3> grids[] = { { 100, 100, 100 }, { 1'000'000, 1, 1 }, { 1, 1000, 1000 } };
  std::mt19937 random(1);
  for (const std::array<int, 3>& counts : grids)
  {
    const ProcessGrid grid = make_process_grid(unit_cube(counts));
    std::vector<Subdomain> subdomains = grid.subdomains(0, grid.size());
    std::ranges::shuffle(subdomains, random);
    const auto found = find_process_grid(subdomains);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->cuts == grid.cuts);
  }
}
