// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/smooth_cells.h"

#include "granular/common/error.h"
#include "granular/numbers/number_print.h"

#include <cmath>
#include <string>

namespace granular
{
namespace
{
/// Largest number of cells that a kernel reaches.
constexpr double most_cells_of_kernel = 1e8;
}

SmoothCells::SmoothCells(
  const EulerGrid& grid, const Kernel& kernel, KernelBounds bounds, const PeriodicImages& images)
  : grid_(grid)
  , kernel_(kernel)
  , images_(images)
  , finder_(grid)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    smooth_[axis] = grid.counts[axis] > 1;
    bounded_[axis] = bounds == KernelBounds::Inside && smooth_[axis] && !images.repeats(axis);
    spacing_[axis] = grid.spacing(axis);
  }
}

void SmoothCells::check(double length) const
{
  double cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    cells *= smooth_[axis] ? (length + 2 * kernel_.support()) / spacing_[axis] + 1 : 1;
  }
  if (!(cells < most_cells_of_kernel))
  {
    const std::string lines =
      length > 0 ? " and contacts up to " + to_text(length) + " long" : std::string();
    throw LimitError("expected a kernel that is not much wider than the cells, got a width of " +
      to_text(kernel_.width()) + lines + ", which reaches over " + to_text(std::floor(cells)) +
      " cells");
  }
}

Vector3 SmoothCells::reach(const Vector3& branch) const noexcept
{
  Vector3 reach = {};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    // twice the spacing, where a kernel without cells falls back on the one that it is in
    reach[axis] =
      smooth_[axis] ? std::max(kernel_.support(), spacing_[axis]) + std::abs(branch[axis]) / 2 : 0;
  }
  return reach;
}

/// Along an axis with one cell all that begins in the middle of the line counts, and an image only once; along an axis that
/// ends at faces only lines inside.
bool SmoothCells::is_inside(const Vector3& middle) const noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double x = middle[axis];
    if (!smooth_[axis] && (finder_.find(axis, x) < 0 || images_.is_twice(axis, x)))
    {
      return false;
    }
    if (bounded_[axis] && finder_.find(axis, x) < 0)
    {
      return false;
    }
  }
  return true;
}

/// The cells whose centres may be that near to a part of an axis, first and last + 1, also beyond the faces.
std::array<std::int64_t, 2> SmoothCells::cells_near(
  std::size_t axis, double lo, double hi) const noexcept
{
  if (!smooth_[axis])
  {
    return { 0, 1 };
  }
  const double reach = kernel_.support();
  const double first = std::floor((lo - reach - grid_.lo[axis]) / spacing_[axis] - 0.5);
  const double last = std::ceil((hi + reach - grid_.lo[axis]) / spacing_[axis] - 0.5) + 1;
  const auto count = static_cast<double>(grid_.counts[axis]);
  return bounded_[axis]
    ? std::array{ static_cast<std::int64_t>(std::clamp(first, 0.0, count)),
        static_cast<std::int64_t>(std::clamp(last, 0.0, count)) }
    : std::array{ static_cast<std::int64_t>(first), static_cast<std::int64_t>(last) };
}

CellRange SmoothCells::range(
  const Vector3& start, const Vector3& branch, const Vector3& middle) const noexcept
{
  CellRange range;
  if (!this->is_inside(middle))
  {
    return range;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double lo = std::min(start[axis], start[axis] + branch[axis]);
    const double hi = std::max(start[axis], start[axis] + branch[axis]);
    const auto [first, last] = this->cells_near(axis, lo, hi);
    range.first[axis] = std::clamp<std::int64_t>(first, 0, grid_.counts[axis]);
    range.last[axis] = std::clamp<std::int64_t>(last, 0, grid_.counts[axis]);
  }
  return range;
}

void SmoothCells::find(const Vector3& start, const Vector3& branch, const CellRange& within,
  Room& room, double& all) const
{
  CellRange near;
  Vector3 across = branch; // what the kernel sees of it
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double end = start[axis] + branch[axis];
    const auto [first, last] =
      this->cells_near(axis, std::min(start[axis], end), std::max(start[axis], end));
    near.first[axis] = first;
    near.last[axis] = last;
    across[axis] = smooth_[axis] ? branch[axis] : 0;
    room.places[axis].clear();
    for (std::int64_t cell = first; cell < last; ++cell)
    {
      room.places[axis].push_back(smooth_[axis] ? grid_.centre(axis, cell) - start[axis] : 0);
    }
  }
  room.weights.clear();
  if (across == Vector3{})
  {
    this->find_point(near, within, room, all);
  }
  else
  {
    this->find_line(across, near, within, room, all);
  }
}

/// A Gaussian is the product of those along the axes.
void SmoothCells::find_point(
  const CellRange& near, const CellRange& within, Room& room, double& all) const
{
  const bool gaussian = kernel_.shape() == KernelShape::Gaussian;
  const double square_of_support = kernel_.support() * kernel_.support();
  for (std::size_t axis = 0; gaussian && axis < 3; ++axis)
  {
    room.values[axis].clear();
    for (const double place : room.places[axis])
    {
      room.values[axis].push_back(kernel_.value(place * place));
    }
  }
  const auto& [x, y, z] = room.places;
  const auto& [gx, gy, gz] = room.values;
  for (std::size_t k = 0; k < z.size(); ++k)
  {
    for (std::size_t j = 0; j < y.size(); ++j)
    {
      const double beside = z[k] * z[k] + y[j] * y[j];
      if (!(beside < square_of_support))
      {
        continue;
      }
      for (std::size_t i = 0; i < x.size(); ++i)
      {
        const double square = beside + x[i] * x[i];
        if (!(square < square_of_support))
        {
          continue;
        }
        const double weight = gaussian ? gz[k] * gy[j] * gx[i] : kernel_.value(square);
        all += weight;
        const std::int64_t cell = within.number({ near.first[0] + static_cast<std::int64_t>(i),
          near.first[1] + static_cast<std::int64_t>(j),
          near.first[2] + static_cast<std::int64_t>(k) });
        if (cell >= 0 && weight > 0)
        {
          room.weights.push_back({ cell, weight });
        }
      }
    }
  }
}

void SmoothCells::find_line(const Vector3& branch, const CellRange& near, const CellRange& within,
  Room& room, double& all) const
{
  const auto place_of = [&](const std::array<std::int64_t, 3>& cell, std::size_t axis)
  { return room.places[axis][static_cast<std::size_t>(cell[axis] - near.first[axis])]; };
  near.each(
    [&](const std::array<std::int64_t, 3>& cell)
    {
      const Vector3 place = { place_of(cell, 0), place_of(cell, 1), place_of(cell, 2) };
      const double weight = kernel_.line_mean(place, branch);
      all += weight;
      if (const std::int64_t number = within.number(cell); number >= 0 && weight > 0)
      {
        room.weights.push_back({ number, weight });
      }
    });
}
}
