// SPDX-License-Identifier: BSD-3-Clause
// The lengths of lines in cells, against clipping with 113 bits.
#include "granular/averages/line_cells.h"
#include "granular/common/error.h"

#include "../support/hard_case.h"
#include "../support/quad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <random>
#include <vector>

using namespace granular;

namespace
{
struct Line
{
  Vector3 start;
  Vector3 branch;
};

const EulerGrid grids[] = { { { -1, 0, 2 }, { 1, 3, 3 }, { 6, 7, 4 } },
  { { -0.7, 0.2, 2.1 }, { 0.9, 2.2, 2.9 }, { 5, 1, 3 } },
  { { 1e3, -1e3, 0 }, { 1e3 + 0.7, -1e3 + 1.1, 0.1 }, { 7, 11, 13 } },
  { { 0, 0, 0 }, { 0.1, 0.1, 0.1 }, { 1, 1, 1 } } };

std::size_t number_of(const EulerGrid& grid, const std::array<std::int64_t, 3>& cell)
{
  return static_cast<std::size_t>((cell[2] * grid.counts[1] + cell[1]) * grid.counts[0] + cell[0]);
}

/// Shares of all cells; those of a range have to be the same, and no cell outside of each_range may have one.
std::vector<double> shares_of(const EulerGrid& grid, const Line& line, const Box* box = nullptr)
{
  WeightOptions options; // any but a kernel
  const LineCells cells(grid, options, box);
  EXPECT_GE(cells.check(0), 1);
  const CellRange all = { {}, grid.counts };
  std::vector<double> shares(static_cast<std::size_t>(grid.size()));
  LineCells::Room room;
  cells.each_share(line.start, line.branch, all, room,
    [&](std::int64_t cell, double share)
    {
      EXPECT_GT(share, 0);
      EXPECT_LE(share, 1);
      shares[static_cast<std::size_t>(cell)] += share;
    });
  std::vector<bool> in_range(shares.size());
  cells.each_range(line.start, line.branch,
    [&](const CellRange& range)
    {
      range.each(
        [&](const std::array<std::int64_t, 3>& cell) { in_range[number_of(grid, cell)] = true; });
    });
  for (std::size_t i = 0; i < shares.size(); ++i)
  {
    EXPECT_TRUE(shares[i] == 0 || in_range[i]) << i;
  }
  const CellRange part = { { 0, 0, 0 },
    { (grid.counts[0] + 1) / 2, grid.counts[1], (grid.counts[2] + 1) / 2 } };
  std::vector<double> some(static_cast<std::size_t>(part.size()));
  cells.each_share(line.start, line.branch, part, room,
    [&](std::int64_t cell, double share) { some[static_cast<std::size_t>(cell)] += share; });
  part.each(
    [&](const std::array<std::int64_t, 3>& cell) {
      EXPECT_EQ(some[static_cast<std::size_t>(part.number(cell))], shares[number_of(grid, cell)]);
    });
  return shares;
}

double sum_of(const std::vector<double>& shares)
{
  return static_cast<double>(std::accumulate(shares.begin(), shares.end(), Quad(0)));
}

/// The part of a line between the faces of a cell: from the last place where it comes in to the first where it goes out.
Quad clip(const EulerGrid& grid, const Line& line, const std::array<std::int64_t, 3>& cell)
{
  Quad from = 0;
  Quad to = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Quad lo = Quad(grid.face(axis, cell[axis])) - line.start[axis];
    const Quad hi = Quad(grid.face(axis, cell[axis] + 1)) - line.start[axis];
    const Quad b = line.branch[axis];
    if (b == 0)
    {
      const bool last = cell[axis] + 1 == grid.counts[axis];
      to = lo <= 0 && (hi > 0 || (last && hi == 0)) ? to : 0;
      continue;
    }
    from = std::max<Quad>(from, (b > 0 ? lo : hi) / b);
    to = std::min<Quad>(to, (b > 0 ? hi : lo) / b);
  }
  return std::max<Quad>(to - from, 0);
}

std::vector<double> clipped(const EulerGrid& grid, const Line& line)
{
  std::vector<double> parts(static_cast<std::size_t>(grid.size()));
  CellRange({ {}, grid.counts })
    .each([&](const std::array<std::int64_t, 3>& cell)
      { parts[number_of(grid, cell)] = static_cast<double>(clip(grid, line, cell)); });
  return parts;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b)
{
  double largest = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

/// With both ends inside, or only near the grid.
Line random_line(const EulerGrid& grid, double length, double beyond, std::mt19937_64& random)
{
  std::uniform_real_distribution<double> unit(0, 1);
  Line line;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double edge = grid.hi[k] - grid.lo[k];
    const auto place = [&]
    { return grid.lo[k] + edge * ((1 + 2 * beyond) * unit(random) - beyond); };
    line.start[k] = place();
    const double other = beyond == 0 ? place() : place() + 2 * beyond * edge * unit(random);
    line.branch[k] = length * (other - line.start[k]);
  }
  return line;
}
}

TEST(LineCells, LengthsInCellsAreThoseOfClippedLines)
{
  HardCase hard("lines", "parts of lines in cells by length, against 113 bits: error", "1", 6e-16);
  std::mt19937_64 random(1);
  for (const EulerGrid& grid : grids)
  {
    for (const double length : { 1e-6, 0.1, 1.0 })
    {
      for (const double beyond : { 0.0, 0.5, 5.0 })
      {
        for (int i = 0; i < 50; ++i)
        {
          const Line line = random_line(grid, length, beyond, random);
          hard.add(largest_difference(shares_of(grid, line), clipped(grid, line)));
        }
      }
    }
  }
}

TEST(LineCells, SharesOfLinesInsideHaveTheSumOneExactly)
{
  HardCase hard("lines", "parts by length of lines inside: sum other than 1", "lines", 0);
  std::mt19937_64 random(2);
  for (const EulerGrid& grid : grids)
  {
    for (const double length : { 1e-300, 1e-12, 1e-3, 0.1, 1.0 })
    {
      for (int i = 0; i < 200; ++i)
      {
        hard.add(sum_of(shares_of(grid, random_line(grid, length, 0, random))) == 1 ? 0 : 1);
      }
    }
  }
}

TEST(LineCells, LinesOnFacesAndAlongEdgesBelongToTheCellsAbove)
{
  const EulerGrid grid = { { 0, 0, 0 }, { 4, 4, 4 }, { 4, 4, 4 } };
  for (std::int64_t face = 0; face <= 4; ++face)
  {
    const std::int64_t cell = std::min<std::int64_t>(face, 3);
    const auto at = static_cast<double>(face);
    for (const double direction : { 1.0, -1.0 })
    {
      const Line on_face = { { direction > 0 ? 0.5 : 2.5, at, 1.25 }, { 2 * direction, 0, 0 } };
      std::vector<double> shares = shares_of(grid, on_face);
      EXPECT_EQ(shares[number_of(grid, { 0, cell, 1 })], 0.25);
      EXPECT_EQ(shares[number_of(grid, { 1, cell, 1 })], 0.5);
      EXPECT_EQ(shares[number_of(grid, { 2, cell, 1 })], 0.25);
      EXPECT_EQ(sum_of(shares), 1);
      EXPECT_EQ(shares, clipped(grid, on_face));

      const Line along_edge = { { at, at, direction > 0 ? 0.0 : 4.0 }, { 0, 0, 4 * direction } };
      shares = shares_of(grid, along_edge);
      for (std::int64_t k = 0; k < 4; ++k)
      {
        EXPECT_EQ(shares[number_of(grid, { cell, cell, k })], 0.25);
      }
      EXPECT_EQ(sum_of(shares), 1);
    }
  }
}

TEST(LineCells, LinesThroughCornersTouchNoOtherCells)
{
  const EulerGrid grid = { { -2, -2, -2 }, { 2, 2, 2 }, { 4, 4, 4 } };
  for (const double x : { 1.0, -1.0 })
  {
    for (const double y : { 1.0, -1.0 })
    {
      const std::vector<double> shares =
        shares_of(grid, { { -2 * x, -2 * y, -2 }, { 4 * x, 4 * y, 4 } });
      for (std::int64_t k = 0; k < 4; ++k)
      {
        const std::int64_t i = x > 0 ? k : 3 - k;
        const std::int64_t j = y > 0 ? k : 3 - k;
        EXPECT_EQ(shares[number_of(grid, { i, j, k })], 0.25);
      }
      EXPECT_EQ(sum_of(shares), 1);
    }
  }
  // from outside to outside through the corners of one cell
  const std::vector<double> shares = shares_of(grid, { { -4, -4, -4 }, { 16, 16, 16 } });
  EXPECT_EQ(shares[number_of(grid, { 0, 0, 0 })], 1.0 / 16);
  EXPECT_EQ(sum_of(shares), 0.25);
}

TEST(LineCells, LinesWithoutLengthAreInTheCellOfTheirPlace)
{
  const EulerGrid grid = { { 0, 0, 0 }, { 4, 4, 4 }, { 4, 4, 4 } };
  EXPECT_EQ(shares_of(grid, { { 2, 0, 3.5 }, {} })[number_of(grid, { 2, 0, 3 })], 1);
  EXPECT_EQ(shares_of(grid, { { 4, 4, 4 }, {} })[number_of(grid, { 3, 3, 3 })], 1);
  EXPECT_EQ(sum_of(shares_of(grid, { { 2, 0, 3.5 }, {} })), 1);
  EXPECT_EQ(sum_of(shares_of(grid, { { 2, -0.001, 3.5 }, {} })), 0);
  EXPECT_EQ(sum_of(shares_of(grid, { { 2, 0, 3.5 }, { 0, 0, 1e-320 } })), 1);
}

/// All coordinates have few bits, so that the other end is a double.
TEST(LineCells, ReversedLinesHaveTheSameShares)
{
  std::mt19937_64 random(3);
  const auto number = [&] { return static_cast<double>(random() % 4096) / 1024; };
  const EulerGrid grid = { { 0, 0, 0 }, { 4, 4, 4 }, { 8, 4, 16 } };
  for (int i = 0; i < 500; ++i)
  {
    const Vector3 a = { number(), number(), number() };
    const Vector3 b = { number(), number(), number() };
    const Vector3 branch = { b[0] - a[0], b[1] - a[1], b[2] - a[2] };
    const std::vector<double> there = shares_of(grid, { a, branch });
    const std::vector<double> back = shares_of(grid, { b, { -branch[0], -branch[1], -branch[2] } });
    EXPECT_LE(largest_difference(there, back), 1e-15);
    // in a mirror, cells that lie symmetrically
    const Line mirrored = { { 4 - a[0], 4 - a[1], 4 - a[2] },
      { -branch[0], -branch[1], -branch[2] } };
    std::vector<double> turned = shares_of(grid, mirrored);
    std::ranges::reverse(turned);
    EXPECT_LE(largest_difference(there, turned), 1e-15);
  }
}

namespace
{
Box periodic_box(const Vector3& lo, const Vector3& hi, const char* boundary)
{
  Box box = Box::from_bounds(lo, hi);
  box.boundary = boundary;
  return box;
}
}

TEST(LineCells, LinesAcrossPeriodicFacesComeInOnTheOtherSide)
{
  HardCase hard(
    "lines", "parts by length of lines through periodic faces: sum minus 1", "1", 1e-14);
  std::mt19937_64 random(4);
  for (const EulerGrid& grid : grids)
  {
    const Box box = periodic_box(grid.lo, grid.hi, "pp pp pp");
    for (const double length : { 0.01, 0.3, 3.0 }) // the last are longer than the box
    {
      for (int i = 0; i < 100; ++i)
      {
        Line line = random_line(grid, length, 0.5, random);
        hard.add(std::abs(sum_of(shares_of(grid, line, &box)) - 1));
      }
    }
  }
  const EulerGrid grid = { { 0, 0, 0 }, { 4, 4, 4 }, { 4, 4, 4 } };
  const Box box = periodic_box(grid.lo, grid.hi, "pp ff ff");
  const std::vector<double> shares = shares_of(grid, { { 3.5, 0.5, 0.5 }, { 0.75, 0, 0 } }, &box);
  EXPECT_NEAR(shares[3], 2.0 / 3, 1e-15);
  EXPECT_NEAR(shares[0], 1.0 / 3, 1e-15);
  const std::vector<double> around = shares_of(grid, { { 3.5, 0.5, 0.5 }, { 9, 0, 0 } }, &box);
  EXPECT_NEAR(around[3], 2.5 / 9, 1e-15); // 3.5 to 4, 7 to 8, 11 to 12
  EXPECT_NEAR(around[0], 2.5 / 9, 1e-15);
  EXPECT_NEAR(around[1], 2.0 / 9, 1e-15);
}

/// As those of a lattice whose layers are on the faces of the box.
TEST(LineCells, LinesInPeriodicFacesCountOnce)
{
  HardCase hard("lines", "lines in faces of periodic boxes: sum other than 1", "lines", 0);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 2000; ++i)
  {
    const double scale = std::pow(10, 6 * unit(random) - 3);
    Vector3 lo;
    Vector3 hi;
    for (std::size_t k = 0; k < 3; ++k)
    {
      lo[k] = scale * (unit(random) - 0.7);
      hi[k] = lo[k] + scale * (0.1 + unit(random));
    }
    const EulerGrid grid = { lo, hi, { 3, 1, 2 } };
    const Box box = periodic_box(lo, hi, "pp pp pp");
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (const double face : { lo[axis], hi[axis] })
      {
        Line line = { { (lo[0] + hi[0]) / 2, (lo[1] + hi[1]) / 2, (lo[2] + hi[2]) / 2 }, {} };
        line.start[axis] = face;
        const std::size_t along = (axis + 1) % 3;
        line.branch[along] = (hi[along] - lo[along]) / 4;
        hard.add(sum_of(shares_of(grid, line, &box)) == 1 ? 0 : 1);
        line.branch[axis] = 1e-20 * scale; // nearly in the face
        hard.add(sum_of(shares_of(grid, line, &box)) == 1 ? 0 : 1);
      }
    }
  }
}

TEST(LineCells, LinesOfManyPeriodsAreRefused)
{
  const EulerGrid grid = { { 0, 0, 0 }, { 1, 1, 1 }, { 2, 2, 2 } };
  const Box box = periodic_box(grid.lo, grid.hi, "pp ff ff");
  const LineCells cells(grid, {}, &box);
  EXPECT_EQ(cells.check(0.1), 1);
  EXPECT_EQ(cells.check(100), 101);
  EXPECT_THROW(cells.check(1e4), LimitError);
  const LineCells open(grid, {}, nullptr);
  EXPECT_EQ(open.check(1e4), 1);
}
