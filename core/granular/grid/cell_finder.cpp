// SPDX-License-Identifier: BSD-3-Clause
#include "granular/grid/cell_finder.h"

#include <algorithm>

namespace granular
{
CellFinder::CellFinder(const EulerGrid& grid) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double lo = grid.lo[axis];
    const double hi = grid.hi[axis];
    const double spacing = grid.spacing(axis);
    // faces are rounded, and so are the distance from the lowest one and its quotient: some ulps of the largest number
    const double rounding = 0x1p-49 * std::max({ std::abs(lo), std::abs(hi), hi - lo }) / spacing;
    axes_[axis] = { lo, hi, spacing, 1 / spacing, rounding,
      static_cast<double>(grid.counts[axis]) };
  }
}

std::int64_t CellFinder::find_by_faces(std::size_t axis, double x) const noexcept
{
  const Axis& a = axes_[axis];
  if (!(x >= a.lo && x <= a.hi))
  {
    return -1;
  }
  // wrong by one at most: the next faces say by how much
  double cell = std::floor((x - a.lo) * a.per_length);
  cell -= x < a.lo + cell * a.spacing ? 1 : 0;
  cell += x >= a.lo + (cell + 1) * a.spacing ? 1 : 0;
  return static_cast<std::int64_t>(std::min(cell, a.count - 1));
}

bool CellFinder::find_whole(
  const double* centre, double radius, const CellRange& within, std::int64_t& cell) const noexcept
{
  std::array<std::int64_t, 3> cells;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Axis& a = axes_[axis];
    const double place = (centre[axis] - a.lo) * a.per_length;
    const double reach = radius * a.per_length + a.rounding;
    if (!(place > reach && place < a.count))
    {
      return false;
    }
    const auto number = static_cast<std::int32_t>(place);
    if (!(place - number > reach && number + 1.0 - place > reach))
    {
      return false;
    }
    cells[axis] = number;
  }
  cell = within.number(cells);
  return cell >= 0;
}

bool CellFinder::find(
  std::span<const double> points, const CellRange& within, std::int64_t* cells) const noexcept
{
  const auto [x0, y0, z0] = within.first;
  const std::uint64_t nx = static_cast<std::uint64_t>(within.last[0] - x0);
  const std::uint64_t ny = static_cast<std::uint64_t>(within.last[1] - y0);
  const std::uint64_t nz = static_cast<std::uint64_t>(within.last[2] - z0);
  bool all = true;
  for (std::size_t i = 0; i < points.size(); i += 3)
  {
    // below the range they are very large
    const auto x = static_cast<std::uint64_t>(this->find(0, points[i]) - x0);
    const auto y = static_cast<std::uint64_t>(this->find(1, points[i + 1]) - y0);
    const auto z = static_cast<std::uint64_t>(this->find(2, points[i + 2]) - z0);
    const bool inside = x < nx && y < ny && z < nz;
    *cells++ = inside ? static_cast<std::int64_t>((z * ny + y) * nx + x) : -1;
    all = all && inside;
  }
  return all;
}
}
