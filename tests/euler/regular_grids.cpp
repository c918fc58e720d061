// SPDX-License-Identifier: BSD-3-Clause
// Regular grids of cells are found from their centres with six decimals: those of LIGGGHTS, and made ones.
#include "granular/formats/euler/regular_grids.h"

#include "euler_files.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

using namespace granular;

namespace
{
using Cuts = std::array<std::vector<double>, 3>;         ///< of the processes along each axis
using Counts = std::array<std::vector<std::int64_t>, 3>; ///< cells between two cuts

double six_decimals(double value)
{
  return std::round(value * 1e6) / 1e6;
}

/// The cells of one grid, added to a frame.
void add_grid(EulerFrame& frame, const Vector3& lo, const Vector3& hi,
  const std::array<std::int64_t, 3>& counts, double (*round)(double))
{
  const auto centre = [&](std::size_t axis, std::int64_t i)
  {
    return round(lo[axis] +
      (static_cast<double>(i) + 0.5) * ((hi[axis] - lo[axis]) / static_cast<double>(counts[axis])));
  };
  for (std::int64_t k = 0; k < counts[2]; ++k)
  {
    for (std::int64_t j = 0; j < counts[1]; ++j)
    {
      for (std::int64_t i = 0; i < counts[0]; ++i)
      {
        frame.centres.insert(frame.centres.end(), { centre(0, i), centre(1, j), centre(2, k) });
        ++frame.cells;
      }
    }
  }
}

/// `parallel yes`: a grid for each process, with z or x fastest.
EulerFrame made_frame(const Cuts& cuts, const Counts& counts, bool z_fastest = true,
  double (*round)(double) = six_decimals)
{
  EulerFrame frame;
  const std::array<std::size_t, 3> order =
    z_fastest ? std::array<std::size_t, 3>{ 0, 1, 2 } : std::array<std::size_t, 3>{ 2, 1, 0 };
  std::array<std::size_t, 3> p = {};
  const auto size = [&](std::size_t axis) { return counts[order[axis]].size(); };
  for (p[order[0]] = 0; p[order[0]] < size(0); ++p[order[0]])
  {
    for (p[order[1]] = 0; p[order[1]] < size(1); ++p[order[1]])
    {
      for (p[order[2]] = 0; p[order[2]] < size(2); ++p[order[2]])
      {
        Vector3 lo;
        Vector3 hi;
        std::array<std::int64_t, 3> cells;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          lo[axis] = cuts[axis][p[axis]];
          hi[axis] = cuts[axis][p[axis] + 1];
          cells[axis] = counts[axis][p[axis]];
        }
        add_grid(frame, lo, hi, cells, round);
      }
    }
  }
  return frame;
}

std::vector<RegularGrid> grids_of(const EulerFrame& frame, std::string* said = nullptr)
{
  Notices notices;
  std::vector<RegularGrid> grids = find_regular_grids(frame, notices);
  if (said)
  {
    *said = lines_of(notices);
  }
  return grids;
}

std::string error_of(const EulerFrame& frame)
{
  return ::error_of([&] { grids_of(frame); });
}

/// A centre of a grid, without its own functions.
double centre_of(const EulerGrid& grid, std::size_t axis, std::int64_t i)
{
  const auto n = static_cast<double>(grid.counts[axis]);
  return grid.lo[axis] + (grid.hi[axis] - grid.lo[axis]) * ((static_cast<double>(i) + 0.5) / n);
}

/// The grids have all cells of the frame in their order, to a tolerance.
void expect_cells(
  const EulerFrame& frame, const std::vector<RegularGrid>& grids, double tolerance = 2e-6)
{
  std::int64_t cell = 0;
  for (const RegularGrid& grid : grids)
  {
    ASSERT_EQ(grid.first, cell);
    const auto& [nx, ny, nz] = grid.grid.counts;
    for (std::int64_t i = 0; i < nx * ny * nz; ++i, ++cell)
    {
      ASSERT_LT(cell, frame.cells);
      const std::int64_t place[] = { i % nx, i / nx % ny, i / (nx * ny) };
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        ASSERT_NEAR(centre_of(grid.grid, axis, place[axis]),
          frame.centres[static_cast<std::size_t>(3 * cell) + axis], tolerance);
      }
    }
  }
  EXPECT_EQ(cell, frame.cells);
}

void expect_grid(const RegularGrid& grid, const Vector3& lo, const Vector3& hi,
  const std::array<std::int64_t, 3>& counts, double tolerance = 2e-6)
{
  EXPECT_EQ(grid.grid.counts, counts);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(grid.grid.lo[axis], lo[axis], tolerance) << axis;
    EXPECT_NEAR(grid.grid.hi[axis], hi[axis], tolerance) << axis;
  }
}
}

// region block -0.05 0.05 -0.05 0.05 0 0.15
TEST(RegularGrids, OfLiggghts)
{
  std::string said;
  EulerFrame frame = EulerFile(data_file("good/euler_4000.vtk")).read();
  std::vector<RegularGrid> grids = grids_of(frame, &said);
  ASSERT_EQ(grids.size(), 1u);
  expect_grid(grids[0], { -0.05, -0.05, 0 }, { 0.05, 0.05, 0.15 }, { 4, 4, 7 });
  expect_cells(frame, grids);
  // processors 2 1 2, ranks above each other come one after the other, with cells of one size
  frame = EulerFile(data_file("good/euler/parallel_2000.vtk")).read();
  grids = grids_of(frame, &said);
  ASSERT_EQ(grids.size(), 2u);
  expect_grid(grids[0], { -0.05, -0.05, 0 }, { 0, 0.05, 0.15 }, { 2, 4, 6 });
  expect_grid(grids[1], { 0, -0.05, 0 }, { 0.05, 0.05, 0.15 }, { 2, 4, 6 });
  EXPECT_EQ(grids[0].grid.hi[0], grids[1].grid.lo[0]);
  expect_cells(frame, grids);
  EXPECT_EQ(said, "");
}

TEST(RegularGrids, OfPfm)
{
  const std::vector<RegularGrid> grids = grids_of(EulerFile(two_boxes()).read());
  ASSERT_EQ(grids.size(), 1u);
  const RegularGrid expected = { { { -0.5, 0.25, 0.75 }, { 0.5, 0.75, 1.25 }, { 2, 1, 1 } }, 0 };
  EXPECT_EQ(grids[0].grid, expected.grid);
  // the same points without faces: the edges along y and z are guessed
  std::string said;
  const std::vector<RegularGrid> guessed = grids_of(EulerFile(two_points()).read(), &said);
  ASSERT_EQ(guessed.size(), 1u);
  expect_grid(guessed[0], { -0.5, 0.25, 0.75 }, { 0.5, 0.75, 1.25 }, { 2, 1, 1 }, 0);
  const std::string end =
    ", and the file does not say how thick it is: it is taken to be 0.5, the mean of the other "
    "axes\n";
  EXPECT_EQ(said, "there is one cell along y" + end + "there is one cell along z" + end);
}

TEST(RegularGrids, OfNoCells)
{
  EXPECT_TRUE(grids_of({}).empty());
}

// 2 x 1 x 2 processes, all cells of one size: with z fastest, two columns; with x fastest, four grids.
TEST(RegularGrids, OfProcessesAlike)
{
  const Cuts cuts = { { { 0, 1, 2 }, { -3, 5 }, { 0, 1, 2 } } };
  const Counts counts = { { { 3, 3 }, { 8 }, { 4, 4 } } };
  const EulerFrame columns = made_frame(cuts, counts);
  std::vector<RegularGrid> grids = grids_of(columns);
  ASSERT_EQ(grids.size(), 2u);
  expect_grid(grids[0], { 0, -3, 0 }, { 1, 5, 2 }, { 3, 8, 8 });
  expect_grid(grids[1], { 1, -3, 0 }, { 2, 5, 2 }, { 3, 8, 8 });
  expect_cells(columns, grids);
  const EulerFrame rows = made_frame(cuts, counts, false);
  grids = grids_of(rows);
  ASSERT_EQ(grids.size(), 4u);
  expect_grid(grids[1], { 1, -3, 0 }, { 2, 5, 1 }, { 3, 8, 4 });
  expect_grid(grids[2], { 0, -3, 1 }, { 1, 5, 2 }, { 3, 8, 4 });
  expect_cells(rows, grids);
}

// A balanced run: each process has cells of another size.
TEST(RegularGrids, OfProcessesThatDiffer)
{
  const Cuts cuts = { { { -0.3, 0.1, 0.7 }, { 0, 0.9 }, { 0, 0.1234567, 1 } } };
  const Counts counts = { { { 3, 5 }, { 7 }, { 2, 9 } } };
  for (const bool z_fastest : { true, false })
  {
    const EulerFrame frame = made_frame(cuts, counts, z_fastest);
    const std::vector<RegularGrid> grids = grids_of(frame);
    ASSERT_EQ(grids.size(), 4u);
    expect_cells(frame, grids);
    expect_grid(grids[0], { -0.3, 0, 0 }, { 0.1, 0.9, 0.1234567 }, { 3, 7, 2 });
    expect_grid(grids[z_fastest ? 1 : 2], { -0.3, 0, 0.1234567 }, { 0.1, 0.9, 1 }, { 3, 7, 9 });
    expect_grid(grids[3], { 0.1, 0, 0.1234567 }, { 0.7, 0.9, 1 }, { 5, 7, 9 });
    // no gaps: what is next to each other has the same face
    EXPECT_EQ(grids[0].grid.hi[0], grids[3].grid.lo[0]);
    EXPECT_EQ(grids[0].grid.hi[2], grids[3].grid.lo[2]);
    EXPECT_EQ(grids[0].grid.lo[1], grids[3].grid.lo[1]);
  }
}

// A grid one cell thick has the room that the one beside it leaves.
TEST(RegularGrids, OneCellThick)
{
  const Counts many[] = { { { { 1, 4 }, { 3 }, { 2, 2 } } }, { { { 4, 1 }, { 3 }, { 2, 2 } } },
    { { { 3, 4 }, { 3 }, { 1, 5 } } }, { { { 3, 4 }, { 3 }, { 5, 1 } } },
    { { { 1, 4 }, { 3 }, { 1, 3 } } }, { { { 1, 5 }, { 2 }, { 4, 1 } } } };
  for (const Counts& counts : many)
  {
    const Cuts cuts = { { { 0, 0.3, 1 }, { 0, 0.6 }, { 0, 0.17, 0.8 } } };
    for (const bool z_fastest : { true, false })
    {
      std::string said;
      const EulerFrame frame = made_frame(cuts, counts, z_fastest);
      const std::vector<RegularGrid> grids = grids_of(frame, &said);
      EXPECT_EQ(said, "");
      ASSERT_EQ(grids.size(), 4u);
      expect_cells(frame, grids, 4e-6);
      const auto& [x, y, z] = counts;
      expect_grid(grids[0], { 0, 0, 0 }, { 0.3, 0.6, 0.17 }, { x[0], y[0], z[0] }, 6e-6);
      expect_grid(grids[3], { 0.3, 0, 0.17 }, { 1, 0.6, 0.8 }, { x[1], y[0], z[1] }, 6e-6);
    }
  }
}

// All processes have one layer: as thick as they are far from each other.
TEST(RegularGrids, AllOneCellThick)
{
  const Cuts cuts = { { { 0, 1, 2 }, { 0, 1 }, { 0, 0.25, 0.5 } } };
  std::string said;
  const EulerFrame frame = made_frame(cuts, { { { 4, 3 }, { 4 }, { 1, 1 } } }, false);
  const std::vector<RegularGrid> grids = grids_of(frame, &said);
  ASSERT_EQ(grids.size(), 4u);
  EXPECT_EQ(said, "");
  expect_grid(grids[3], { 1, 0, 0.25 }, { 2, 1, 0.5 }, { 3, 4, 1 });
  // each process has one cell
  const EulerFrame ones = made_frame(cuts, { { { 1, 1 }, { 1 }, { 1, 1 } } }, false);
  const std::vector<RegularGrid> all = grids_of(ones, &said);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(said,
    "there is one cell along y, and the file does not say how thick it is: it is taken to be "
    "0.625, the mean of the other axes\n");
  expect_grid(all[0], { 0, 0.1875, 0 }, { 2, 0.8125, 0.5 }, { 2, 1, 2 });
}

TEST(RegularGrids, ManyMadeOnes)
{
  std::mt19937 random(5);
  const auto number = [&](int least, int most)
  { return std::uniform_int_distribution<int>(least, most)(random); };
  for (int round = 0; round < 300; ++round)
  {
    Cuts cuts;
    Counts counts;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      double at = 0.001 * number(-2000, 2000);
      cuts[axis].push_back(at);
      for (int processes = number(1, 3); processes > 0; --processes)
      {
        counts[axis].push_back(number(3, 7));
        at += 0.001 * number(50, 900);
        cuts[axis].push_back(at);
      }
    }
    const EulerFrame frame = made_frame(cuts, counts, round % 2 == 0);
    std::string said;
    const std::vector<RegularGrid> grids = grids_of(frame, &said);
    EXPECT_EQ(said, "");
    expect_cells(frame, grids, 4e-6);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      EXPECT_NEAR(grids.front().grid.lo[axis], cuts[axis].front(), 4e-6);
      EXPECT_NEAR(grids.back().grid.hi[axis], cuts[axis].back(), 4e-6);
    }
  }
}

// ---- how many digits there are -----------------------------------------------------------------------

// Cells of four micrometres, where six decimals just do.
TEST(RegularGrids, SmallCells)
{
  const EulerFrame frame =
    made_frame({ { { 0, 40e-6 }, { 0, 40e-6 }, { 0, 41e-6 } } }, { { { 10 }, { 10 }, { 10 } } });
  const std::vector<RegularGrid> grids = grids_of(frame);
  ASSERT_EQ(grids.size(), 1u);
  expect_grid(grids[0], { 0, 0, 0 }, { 40e-6, 40e-6, 41e-6 }, { 10, 10, 10 });
  // smaller ones coincide
  const EulerFrame small =
    made_frame({ { { 0, 4e-6 }, { 0, 4e-6 }, { 0, 4e-6 } } }, { { { 10 }, { 10 }, { 10 } } });
  EXPECT_NE(error_of(small), "");
  // but not where all digits are there
  const auto all_digits = [](double value) { return value; };
  const EulerFrame exact = made_frame({ { { 0, 4e-6 }, { 0, 4e-6 }, { 0, 4e-6 } } },
    { { { 10 }, { 10 }, { 10 } } }, true, all_digits);
  ASSERT_EQ(grids_of(exact).size(), 1u);
  expect_grid(grids_of(exact)[0], { 0, 0, 0 }, { 4e-6, 4e-6, 4e-6 }, { 10, 10, 10 }, 1e-18);
}

// What VTK makes of them: single precision, or six digits.
TEST(RegularGrids, RoundedByOthers)
{
  const auto single = [](double value) -> double { return static_cast<float>(value); };
  const auto six_digits = [](double value)
  {
    std::array<char, 40> text;
    std::snprintf(text.data(), text.size(), "%g", value);
    return std::stod(text.data());
  };
  const Cuts cuts = { { { 100, 107 }, { -2000, -1990 }, { 0, 3 } } };
  const Counts counts = { { { 30 }, { 20 }, { 7 } } };
  for (double (*round)(double) : { +single, +six_digits })
  {
    const EulerFrame frame = made_frame(cuts, counts, true, round);
    const std::vector<RegularGrid> grids = grids_of(frame);
    ASSERT_EQ(grids.size(), 1u);
    expect_grid(grids[0], { 100, -2000, 0 }, { 107, -1990, 3 }, { 30, 20, 7 }, 0.02);
  }
}

// ---- what is none ------------------------------------------------------------------------------------

TEST(RegularGrids, OthersAreRefused)
{
  const std::string begin =
    "expected cells that form a regular grid, or one for each process, got cell ";
  const EulerFrame good =
    made_frame({ { { 0, 1 }, { 0, 1 }, { 0, 1 } } }, { { { 4 }, { 4 }, { 4 } } });
  EXPECT_EQ(error_of(good), "");
  EulerFrame moved = good;
  moved.centres[3 * 21] += 1e-5;
  EXPECT_EQ(error_of(moved),
    begin +
      "16 at 0.125 0.125 0.375, which does not go on with a grid; there are 6 parts, which "
      "do not fill a box");
  EulerFrame less = good;
  less.centres.resize(3 * 63);
  less.cells = 63;
  EXPECT_TRUE(error_of(less).starts_with(begin + "48 at 0.125 0.125 0.875")) << error_of(less);
  EulerFrame nowhere = good;
  nowhere.centres[3 * 5 + 1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(nowhere), begin + "5 at 0.375 nan 0.125, which is nowhere");
  EulerFrame one = good;
  one.centres.resize(3);
  one.cells = 1;
  EXPECT_EQ(
    error_of(one), begin + "0 at 0.125 0.125 0.125 alone, of which nobody knows how large it is");
  EulerFrame twice = good;
  twice.centres.insert(twice.centres.end(), good.centres.begin(), good.centres.end());
  twice.cells *= 2;
  EXPECT_TRUE(error_of(twice).starts_with(begin + "64 at ")) << error_of(twice);
  // a gap between processes
  EulerFrame gap = made_frame({ { { 0, 1 }, { 0, 1 }, { 0, 1 } } }, { { { 4 }, { 4 }, { 4 } } });
  add_grid(gap, { 2, 0, 0 }, { 3, 1, 1 }, { 4, 4, 4 }, six_decimals);
  EXPECT_EQ(
    error_of(gap), begin + "64 at 2.125 0.125 0.125, which does not begin where others end");
}

TEST(RegularGrids, CloudsAreRefused)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1);
  for (int round = 0; round < 200; ++round)
  {
    EulerFrame cloud;
    for (cloud.cells = 0; cloud.cells < 2 + round; ++cloud.cells)
    {
      cloud.centres.insert(cloud.centres.end(), { place(random), place(random), place(random) });
    }
    EXPECT_NE(error_of(cloud), "") << round;
  }
}

TEST(RegularGrids, FacesThatAreNotEqual)
{
  const std::string grid = replaced(two_boxes(), "-0.500000 0.000000 0.500000", "-0.5 0.1 0.5");
  const std::string begin =
    "expected cells that form a regular grid, or one for each process, got cell 1 at ";
  EXPECT_EQ(
    error_of(EulerFile(grid).read()), begin + "0.3 0.5 1, which is not as large as those before");
  // from high to low
  EXPECT_NE(error_of(EulerFile(
              replaced(two_boxes(), "-0.500000 0.000000 0.500000", "0.500000 0.000000 -0.500000"))
                       .read()),
    "");
}

/// Six decimals forgive a micrometre, other numbers do not.
TEST(RegularGrids, MicrometresThatAreNotEqual)
{
  const auto line = [](const std::vector<double>& places)
  {
    EulerFrame frame;
    for (const double y : { 0.5e-6, 1.5e-6 })
    {
      for (const double x : places)
      {
        frame.centres.insert(frame.centres.end(), { x, y, 0.1234567891234e-6 });
        ++frame.cells;
      }
    }
    return frame;
  };
  EXPECT_EQ(error_of(line({ 0.5e-6, 1.5e-6, 2.5e-6, 3.5e-6 })), "");
  EXPECT_NE(error_of(line({ 0.5e-6, 1.5e-6, 2.7e-6, 3.3e-6 })), "");
  EXPECT_EQ(error_of(line({ 4e-6, 8e-6, 13e-6, 17e-6 })), ""); // may be 4.25 apart
}

/// One layer so far away that numbers cannot hold its thickness.
TEST(RegularGrids, ALayerWithoutRoom)
{
  EulerFrame frame;
  add_grid(frame, { 0, 0, 1e30 }, { 2, 2, 1e30 }, { 2, 2, 1 }, [](double value) { return value; });
  EXPECT_NE(error_of(frame).find("no room"), std::string::npos);
  Notices notices;
  EXPECT_THROW(find_regular_grids(frame, notices), UnsupportedError);
  EXPECT_TRUE(notices.empty());
}
