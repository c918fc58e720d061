// SPDX-License-Identifier: BSD-3-Clause
// Points and lines that a kernel divides among cells, against the definition with 113 bits.
#include "exact_parts.h"

#include "../support/error_of.h"
#include "../support/hard_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

using namespace granular;

namespace
{
const EulerGrid grids[] = { { { -1, 0, 2 }, { 1, 3, 3 }, { 6, 7, 4 } },
  { { -0.7, 0.2, 2.1 }, { 0.9, 2.2, 2.9 }, { 5, 3, 1 } },
  { { 1e3, 0, 0 }, { 1e3 + 0.7, 1, 2 }, { 7, 1, 1 } },
  { { 1e6, -1e6, 3e6 }, { 1e6 + 0.7, -1e6 + 1, 3e6 + 2 }, { 7, 5, 3 } } };

/// What each() gives for all cells of a grid, or of a range of them.
struct Parts
{
  explicit Parts(const Smoothing& smoothing, const Line& line)
    : Parts(smoothing, line, { {}, smoothing.grid.counts })
  {
  }

  Parts(const Smoothing& smoothing, const Line& line, const CellRange& within)
    : parts(static_cast<std::size_t>(within.size()))
  {
    Box box = Box::from_bounds(smoothing.grid.lo, smoothing.grid.hi);
    box.boundary = "";
    for (const bool periodic : smoothing.periodic)
    {
      box.boundary += periodic ? "pp " : "ff ";
    }
    const PeriodicImages images(smoothing.grid, &box);
    const SmoothCells cells(
      smoothing.grid, Kernel(smoothing.shape, smoothing.width), smoothing.bounds, images);
    SmoothCells::Room room;
    Vector3 middle;
    for (std::size_t k = 0; k < 3; ++k)
    {
      middle[k] = line.start[k] + line.branch[k] / 2;
    }
    found = cells.each(line.start, line.branch, middle, within, room,
      [&](std::int64_t cell, double part)
      {
        EXPECT_GT(part, 0);
        EXPECT_LE(part, 1);
        parts.at(static_cast<std::size_t>(cell)) += part;
      });
    range = cells.range(line.start, line.branch, middle);
    reach = cells.reach(line.branch);
  }

  double sum() const
  {
    return static_cast<double>(std::accumulate(parts.begin(), parts.end(), Quad(0)));
  }

  std::vector<double> parts;
  bool found = false;
  CellRange range;
  Vector3 reach;
};

double largest_difference(const std::vector<double>& a, const std::vector<double>& b)
{
  EXPECT_EQ(a.size(), b.size());
  double largest = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
  {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

/// No cell outside of the range has a part, and no line farther than reach has any.
void expect_in_range(const Smoothing& smoothing, const Line& line, const Parts& found)
{
  const CellRange all = { {}, smoothing.grid.counts };
  std::size_t i = 0;
  bool any = false;
  all.each(
    [&](const std::array<std::int64_t, 3>& cell)
    {
      any = any || found.parts[i] > 0;
      EXPECT_TRUE(found.parts[i] == 0 || found.range.number(cell) >= 0);
      ++i;
    });
  for (std::size_t axis = 0; any && axis < 3; ++axis)
  {
    const double middle = line.start[axis] + line.branch[axis] / 2;
    EXPECT_GE(middle, smoothing.grid.lo[axis] - found.reach[axis] * (1 + 1e-12));
    EXPECT_LE(middle, smoothing.grid.hi[axis] + found.reach[axis] * (1 + 1e-12));
  }
}

constexpr int trials = 4 * 3 * 2 * 2 * 8;

/// The largest difference of any part from the exact one.
double check_lines(double length, double beyond, unsigned seed)
{
  double worst = 0;
  for (const EulerGrid& grid : grids)
  {
    const std::vector<Line> lines = random_lines(grid, 8, length, seed, beyond);
    for (const KernelShape shape : all_shapes)
    {
      for (const KernelBounds bounds : { KernelBounds::None, KernelBounds::Inside })
      {
        for (const double width : { 0.3, 0.11 })
        {
          const Smoothing smoothing = { grid, shape, width, bounds };
          for (const Line& line : lines)
          {
            const ExactParts exact = exact_parts(smoothing, line);
            const Parts found(smoothing, line);
            expect_in_range(smoothing, line, found);
            const double difference =
              exact.parts.empty() ? found.sum() : largest_difference(found.parts, exact.parts);
            // who barely touches one kernel has parts of what that is
            worst = std::max(worst, difference * std::min(exact.all, 1.0));
            EXPECT_LE(worst, 2e-14) << width;
          }
        }
      }
    }
  }
  return worst;
}
}

TEST(SmoothCells, PartsOfPointsAreThoseOfTheDefinition)
{
  HardCase hard(
    "kernels", "parts of points in cells up to 3e6 away, against 113 bits: error", "1", 1e-14);
  hard.add(check_lines(0, 0, 1), trials);
  hard.add(check_lines(0, 0.4, 2), trials);
}

TEST(SmoothCells, PartsOfLinesAreThoseOfTheDefinition)
{
  HardCase hard(
    "kernels", "parts of lines in cells up to 3e6 away, against 113 bits: error", "1", 2e-14);
  hard.add(check_lines(0.4, 0, 3), trials);
  hard.add(check_lines(0.4, 0.4, 4), trials);
  hard.add(check_lines(2.5, 0.2, 5), trials);
}

TEST(SmoothCells, PartsHaveTheSumOneWhereNothingIsLost)
{
  HardCase hard("kernels", "parts in all cells of what is inside: sum minus 1", "1", 1e-13);
  const EulerGrid fine = { { -1, 0, 2 }, { 1, 3, 3 }, { 20, 24, 11 } };
  for (const KernelShape shape : all_shapes)
  {
    for (const double length : { 0.0, 0.3 })
    {
      for (const double width : { 0.15, 0.5, 40.0 })
      {
        const Smoothing inside = { fine, shape, width, KernelBounds::Inside };
        for (const Line& line : random_lines(fine, 20, length, 6))
        {
          hard.add(std::abs(Parts(inside, line).sum() - 1));
        }
      }
      // far from the faces nothing needs to be kept inside
      const Smoothing open = { fine, shape, 0.1 };
      const EulerGrid middle = { { -0.4, 0.6, 2.47 }, { 0.4, 2.4, 2.53 }, { 1, 1, 1 } };
      for (const Line& line : random_lines(middle, 20, length / 10, 7))
      {
        hard.add(std::abs(Parts(open, line).sum() - 1));
      }
    }
  }
}

/// In a fine grid that is large enough a part is the integral of the kernel over the cell.
TEST(SmoothCells, PartsInFineGridsAreTheKernelOverItsVolume)
{
  const EulerGrid grid = { { -1, -1, -1 }, { 1, 1, 1 }, { 80, 80, 80 } };
  for (const KernelShape shape : all_shapes)
  {
    const Kernel kernel(shape, 0.3);
    const Vector3 place = { 0.011, -0.023, 0.005 };
    const Parts found({ grid, shape, 0.3 }, { place, {} });
    const double cell = std::pow(2.0 / 80, 3);
    const Vector3 r = { grid.centre(0, 43) - place[0], grid.centre(1, 39) - place[1],
      grid.centre(2, 45) - place[2] };
    EXPECT_NEAR(
      found.parts[(45 * 80 + 39) * 80 + 43] / (kernel.value(dot(r, r)) / kernel.volume() * cell), 1,
      shape == KernelShape::Lucy ? 1e-5 : 5e-3);
  }
}

TEST(SmoothCells, NarrowKernelsHaveNoCell)
{
  const EulerGrid grid = { { 0, 0, 0 }, { 4, 4, 4 }, { 4, 4, 4 } };
  for (const KernelShape shape : all_shapes)
  {
    for (const KernelBounds bounds : { KernelBounds::None, KernelBounds::Inside })
    {
      const Smoothing smoothing = { grid, shape, 0.01, bounds };
      for (const Vector3& branch : { Vector3{}, Vector3{ 0.02, 0.01, 0.1 } })
      {
        const Parts found(smoothing, { { 1, 2, 3 }, branch }); // of centres at 0.5, 1.5, ...
        EXPECT_FALSE(found.found);
        EXPECT_EQ(found.sum(), 0);
        // who is outside along an axis on which the kernel ends belongs to no cell, however narrow it is
        EXPECT_EQ(
          Parts(smoothing, { { 1, 2, 4.25 }, branch }).found, bounds == KernelBounds::Inside);
      }
      const Parts centred(smoothing, { { 1.5, 2.505, 3.5 }, {} });
      EXPECT_TRUE(centred.found);
      EXPECT_EQ(centred.parts[(3 * 4 + 2) * 4 + 1], 1);
      EXPECT_EQ(centred.sum(), 1);
      // the line goes through one centre
      const Parts through(smoothing, { { 1.4, 2.4, 3.4 }, { 0.2, 0.2, 0.2 } });
      EXPECT_TRUE(through.found);
      EXPECT_EQ(through.parts[(3 * 4 + 2) * 4 + 1], 1);
    }
  }
}

TEST(SmoothCells, AxesWithOneCellAreNotSmoothed)
{
  for (const KernelShape shape : all_shapes)
  {
    for (const KernelBounds bounds : { KernelBounds::None, KernelBounds::Inside })
    {
      // one cell has all that is between its faces, or begins in its middle
      const Smoothing one = { { { 0, 0, 0 }, { 1, 1, 1 }, { 1, 1, 1 } }, shape, 0.2, bounds };
      for (const Vector3& branch : { Vector3{}, Vector3{ 0.5, -0.25, 3 } })
      {
        const auto sum = [&](double x, double y, double z)
        {
          return Parts(one, { { x - branch[0] / 2, y - branch[1] / 2, z - branch[2] / 2 }, branch })
            .sum();
        };
        EXPECT_EQ(sum(0.5, 0.01, 0.75), 1);
        EXPECT_EQ(sum(0, 1, 0), 1);
        EXPECT_EQ(sum(-0.01, 0.5, 0.5), 0);
        EXPECT_EQ(sum(0.5, 0.5, 1.01), 0);
      }
      // layers do not know where in them a point is
      const Smoothing layers = { { { 0, 0, 0 }, { 1, 1, 1 }, { 1, 1, 9 } }, shape, 0.2, bounds };
      EXPECT_EQ(Parts(layers, { { 0.5, 0.5, 0.3 }, {} }).parts,
        Parts(layers, { { 0.01, 0.99, 0.3 }, {} }).parts);
      EXPECT_EQ(Parts(layers, { { 0.5, 0.5, 0.3 }, { 0, 0, 0.2 } }).parts,
        Parts(layers, { { 0.2, 0.3, 0.3 }, { 0.125, 0.3, 0.2 } }).parts);
      EXPECT_EQ(Parts(layers, { { 1.01, 0.5, 0.3 }, {} }).sum(), 0);
    }
  }
}

TEST(SmoothCells, PeriodicAxesAreNeverBounded)
{
  const EulerGrid grid = { { 0, 0, 0 }, { 1, 1, 1 }, { 8, 8, 8 } };
  for (const KernelShape shape : all_shapes)
  {
    const Line line = { { 0.01, 0.4, 0.97 }, { 0, 0, 0.05 } };
    const Smoothing open = { grid, shape, 0.12, KernelBounds::None };
    Smoothing periodic = { grid, shape, 0.12, KernelBounds::Inside, { true, true, true } };
    EXPECT_EQ(Parts(periodic, line).parts, Parts(open, line).parts);
    EXPECT_LT(Parts(periodic, line).sum(), 0.8);
    periodic.periodic = { false, true, false };
    EXPECT_NEAR(Parts(periodic, line).sum(), 1, 1e-13);
  }
}

/// Where a grid ends does not matter to the cells that it has.
TEST(SmoothCells, GridsThatCoverOnlyAPartHaveThePartsOfTheWhole)
{
  const EulerGrid whole = { { -4, -4, -4 }, { 4, 4, 4 }, { 16, 16, 16 } };
  const EulerGrid part = { { -1, 0, 1 }, { 1, 1, 2 }, { 4, 2, 2 } };
  for (const KernelShape shape : all_shapes)
  {
    for (const double length : { 0.0, 0.9 })
    {
      for (const Line& line : random_lines(part, 30, length, 8, 0.5))
      {
        const Parts of_whole({ whole, shape, 0.4 }, line);
        const Parts of_part({ part, shape, 0.4 }, line);
        const Parts of_range({ whole, shape, 0.4 }, line, { { 6, 8, 10 }, { 10, 10, 12 } });
        EXPECT_EQ(of_range.parts, of_part.parts);
        std::size_t i = 0;
        CellRange({ { 6, 8, 10 }, { 10, 10, 12 } })
          .each(
            [&](const std::array<std::int64_t, 3>& cell)
            {
              const auto number = static_cast<std::size_t>((cell[2] * 16 + cell[1]) * 16 + cell[0]);
              EXPECT_EQ(of_part.parts[i++], of_whole.parts[number]);
            });
      }
    }
  }
}

TEST(SmoothCells, KernelsMuchWiderThanTheGridGiveAllCellsTheSame)
{
  const EulerGrid grid = { { 0, 0, 0 }, { 1, 1, 1 }, { 3, 3, 3 } };
  for (const KernelShape shape : all_shapes)
  {
    const Parts inside({ grid, shape, 1e6, KernelBounds::Inside }, { { 0.1, 0.9, 0.2 }, {} });
    for (const double part : inside.parts)
    {
      EXPECT_NEAR(part, 1.0 / 27, 1e-11);
    }
    // of all space the grid has little: its volume over that of the kernel
    const double fraction = 1 / Kernel(shape, 6).volume();
    EXPECT_NEAR(Parts({ grid, shape, 6 }, { { 0.5, 0.5, 0.5 }, {} }).sum() / fraction, 1, 0.02);
  }
}

TEST(SmoothCells, KernelsOfTooManyCellsAreRefused)
{
  const auto error_of = [](const EulerGrid& grid, double width, double length = 0)
  {
    const PeriodicImages images(grid, nullptr);
    return ::error_of<LimitError>(
      [&]
      {
        SmoothCells(grid, Kernel(KernelShape::Gaussian, width), KernelBounds::None, images)
          .check(length);
      });
  };
  const EulerGrid fine = { { 0, 0, 0 }, { 1, 1, 1 }, { 100, 100, 100 } };
  EXPECT_EQ(error_of(fine, 0.7), ""); // 421 cells along each axis
  EXPECT_EQ(error_of(fine, 0.8),
    "expected a kernel that is not much wider than the cells, got a width of 0.8, which reaches "
    "over 111284641 cells");
  EXPECT_NE(error_of(fine, 1e30), "");
  EXPECT_EQ(error_of(fine, 0.1, 3.6), "");
  EXPECT_EQ(error_of(fine, 0.1, 4.6),
    "expected a kernel that is not much wider than the cells, got a width of 0.1 and contacts up "
    "to 4.6 long, which reaches over 141420760 cells");
  EXPECT_NE(error_of(fine, 0.1, 1e30), "");
  // along axes with one cell there is no kernel
  EXPECT_EQ(error_of({ { 0, 0, 0 }, { 1, 1, 1 }, { 1, 1, 100 } }, 1e5), "");
  EXPECT_NE(error_of({ { 0, 0, 0 }, { 1, 1, 1 }, { 1, 1, 100 } }, 1e6), "");
}
