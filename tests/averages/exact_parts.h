// SPDX-License-Identifier: BSD-3-Clause
// The parts of points and lines in cells, from the definition: each cell of a lattice after the other, with 113 bits.
#ifndef granular_tests_kernels_exact_parts_h
#define granular_tests_kernels_exact_parts_h

#include "exact_kernel.h"

#include "granular/averages/smooth_cells.h"
#include "granular/grid/euler_grid.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

inline constexpr granular::KernelShape all_shapes[] = { granular::KernelShape::Gaussian,
  granular::KernelShape::Lucy, granular::KernelShape::Heaviside };

struct Line
{
  granular::Vector3 start = {};
  granular::Vector3 branch = {}; ///< 0: a point
};

struct Smoothing
{
  granular::EulerGrid grid;
  granular::KernelShape shape;
  double width;
  granular::KernelBounds bounds = granular::KernelBounds::None;
  std::array<bool, 3> periodic = {};

  bool smooth(std::size_t axis) const { return grid.counts[axis] > 1; }

  bool bounded(std::size_t axis) const
  {
    return bounds == granular::KernelBounds::Inside && !periodic[axis];
  }

  double support() const { return widths_of_support(shape) * width; }

  std::size_t cells() const { return static_cast<std::size_t>(grid.size()); }
};

/// Cells of an axis that a line may reach, also beyond the grid.
inline std::array<std::int64_t, 2> cells_around(
  const Smoothing& smoothing, const Line& line, std::size_t axis)
{
  const granular::EulerGrid& grid = smoothing.grid;
  if (!smoothing.smooth(axis))
  {
    return { 0, 1 };
  }
  if (smoothing.bounded(axis))
  {
    return { 0, grid.counts[axis] };
  }
  const double end = line.start[axis] + line.branch[axis];
  const double lo = std::min(line.start[axis], end) - smoothing.support() - grid.lo[axis];
  const double hi = std::max(line.start[axis], end) + smoothing.support() - grid.lo[axis];
  return { static_cast<std::int64_t>(std::floor(lo / grid.spacing(axis))) - 2,
    static_cast<std::int64_t>(std::floor(hi / grid.spacing(axis))) + 3 };
}

/// Whether the middle is between the faces of the axes that have a single cell, or where the kernel ends.
inline bool is_between(const Smoothing& smoothing, const Line& line)
{
  bool between = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double middle = line.start[axis] + line.branch[axis] / 2;
    between = between &&
      ((smoothing.smooth(axis) && !smoothing.bounded(axis)) ||
        (middle >= smoothing.grid.lo[axis] && middle <= smoothing.grid.hi[axis]));
  }
  return between;
}

/// The kernel of a cell, seen along the smooth axes alone.
inline Quad exact_weight(
  const Smoothing& smoothing, const Line& line, const std::array<std::int64_t, 3>& cell)
{
  QuadVector place = {};
  QuadVector branch = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (smoothing.smooth(axis))
    {
      place[axis] = Quad(smoothing.grid.centre(axis, cell[axis])) - line.start[axis];
      branch[axis] = line.branch[axis];
    }
  }
  return exact_line_mean(smoothing.shape, smoothing.width, place, branch);
}

struct ExactParts
{
  std::vector<double> parts; ///< of all cells of the grid; empty where no cell has the line at all
  double all = 1;            ///< sum of the kernels of all cells
};

inline ExactParts exact_parts(const Smoothing& smoothing, const Line& line)
{
  const granular::EulerGrid& grid = smoothing.grid;
  const granular::CellRange inside = { {}, grid.counts };
  std::vector<Quad> weights(smoothing.cells());
  Quad all = 0;
  granular::CellRange around;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto [first, last] = cells_around(smoothing, line, axis);
    around.first[axis] = first;
    around.last[axis] = last;
  }
  around.each(
    [&](const std::array<std::int64_t, 3>& cell)
    {
      const Quad weight = exact_weight(smoothing, line, cell);
      all += weight;
      if (const std::int64_t number = inside.number(cell); number >= 0)
      {
        weights[static_cast<std::size_t>(number)] = weight;
      }
    });
  if (!is_between(smoothing, line) || all == 0)
  {
    return {};
  }
  ExactParts exact = { {}, static_cast<double>(all) };
  for (const Quad weight : weights)
  {
    exact.parts.push_back(static_cast<double>(weight / all));
  }
  return exact;
}

/// Lines up to that length, or points, in a grid and beyond it.
inline std::vector<Line> random_lines(const granular::EulerGrid& grid, std::size_t count,
  double length, unsigned seed, double beyond = 0)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Line> lines(count);
  for (Line& line : lines)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      line.branch[k] = length * (2 * unit(random) - 1) / 1.8;
      line.start[k] = grid.lo[k] +
        (grid.hi[k] - grid.lo[k]) * ((1 + 2 * beyond) * unit(random) - beyond) - line.branch[k] / 2;
    }
  }
  return lines;
}
#endif
