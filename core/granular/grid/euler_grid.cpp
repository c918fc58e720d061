// SPDX-License-Identifier: BSD-3-Clause
#include "granular/grid/euler_grid.h"

#include "granular/common/error.h"
#include "granular/numbers/number_print.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace granular
{
namespace
{
constexpr std::array<const char*, 3> axis_names = { "x", "y", "z" };

void check_extent(const Vector3& lo, const Vector3& hi)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!(lo[axis] < hi[axis]) || !std::isfinite(hi[axis] - lo[axis]))
    {
      throw Error(std::string("expected finite bounds of cells, the lower below the upper, got ") +
        to_text(lo[axis]) + " and " + to_text(hi[axis]) + " along " + axis_names[axis]);
    }
  }
}

/// Returns the number of cells of at least that edge: fewer, larger ones where they do not fit. rounding: what may be missing.
std::int64_t count_cells(double length, double edge, double rounding)
{
  const double count = std::floor(length / edge * (1 + rounding));
  if (!(count < static_cast<double>(most_cells_of_axis)))
  {
    throw LimitError("expected less than 2^31 cells along an axis, got edges of " + to_text(edge) +
      " in a box of " + to_text(length));
  }
  return std::max(std::int64_t{ 1 }, static_cast<std::int64_t>(count));
}

std::array<std::int64_t, 3> counts_of(const EulerGridRequest& request)
{
  if (request.by == EulerGridRequest::By::Counts)
  {
    for (const std::int64_t count : request.counts)
    {
      if (count < 1 || count >= most_cells_of_axis)
      {
        throw Error("expected 1 to 2^31 - 1 cells along each axis, got " +
          std::to_string(request.counts[0]) + " " + std::to_string(request.counts[1]) + " " +
          std::to_string(request.counts[2]));
      }
    }
    return request.counts;
  }
  const bool cutoff = request.by == EulerGridRequest::By::Cutoff;
  if (cutoff && request.cutoff == 0)
  {
    return { 1, 1, 1 };
  }
  const Vector3 size =
    cutoff ? Vector3{ request.cutoff, request.cutoff, request.cutoff } : request.size;
  std::array<std::int64_t, 3> counts = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!(size[axis] > 0) || !std::isfinite(size[axis]))
    {
      throw Error("expected edges of cells above 0, got " + to_text(size[0]) + " " +
        to_text(size[1]) + " " + to_text(size[2]));
    }
    counts[axis] = count_cells(request.hi[axis] - request.lo[axis], size[axis], cutoff ? 0 : 1e-12);
  }
  return counts;
}

/// Returns true if no two faces coincide, however they are rounded.
bool have_thickness(const EulerGrid& grid, std::size_t axis) noexcept
{
  const double largest = std::max(std::abs(grid.lo[axis]), std::abs(grid.hi[axis]));
  const double step = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  if (grid.spacing(axis) >= 2 * step)
  {
    return true;
  }
  for (std::int64_t i = 0; i < grid.counts[axis]; ++i)
  {
    if (!(grid.face(axis, i) < grid.face(axis, i + 1)))
    {
      return false;
    }
  }
  return true;
}
}

double EulerGrid::spacing(std::size_t axis) const noexcept
{
  return (hi[axis] - lo[axis]) / static_cast<double>(counts[axis]);
}

double EulerGrid::face(std::size_t axis, std::int64_t i) const noexcept
{
  return i == counts[axis] ? hi[axis] : lo[axis] + static_cast<double>(i) * this->spacing(axis);
}

std::vector<double> EulerGrid::faces(std::size_t axis) const
{
  std::vector<double> faces(static_cast<std::size_t>(counts[axis]) + 1);
  for (std::int64_t i = 0; i <= counts[axis]; ++i)
  {
    faces[static_cast<std::size_t>(i)] = this->face(axis, i);
  }
  return faces;
}

double EulerGrid::centre(std::size_t axis, std::int64_t i) const noexcept
{
  return lo[axis] + (static_cast<double>(i) + 0.5) * this->spacing(axis);
}

EulerGrid make_euler_grid(const EulerGridRequest& request)
{
  check_extent(request.lo, request.hi);
  const EulerGrid grid{ request.lo, request.hi, counts_of(request) };
  double cells = 1;
  for (const std::int64_t count : grid.counts)
  {
    cells *= static_cast<double>(count);
  }
  if (cells > static_cast<double>(most_cells))
  {
    throw LimitError("expected at most 2^40 cells, got " + std::to_string(grid.counts[0]) + " x " +
      std::to_string(grid.counts[1]) + " x " + std::to_string(grid.counts[2]));
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!have_thickness(grid, axis))
    {
      throw Error("expected cells with a thickness, got " + std::to_string(grid.counts[axis]) +
        " between " + to_text(grid.lo[axis]) + " and " + to_text(grid.hi[axis]) + " along " +
        axis_names[axis] + ", of which some have none");
    }
  }
  return grid;
}
}
