// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/grain_cells.h"

#include "granular/dump/point_forms.h"

#include <cmath>

namespace granular
{
namespace
{
/// Of a grain that is larger than its periodic box, along one axis and in either direction.
constexpr double most_images_of_axis = 16;
}

GrainCells::GrainCells(const EulerGrid& grid, const Options& options, const Box* box)
  : grid_(grid)
  , weights_(options.weights)
  , spheres_(grid, options.short_cuts)
  , finder_(grid)
{
  if (!box || box->tilted)
  {
    return;
  }
  const BoxBounds bounds = box->bounds();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool periodic = is_periodic(*box, axis) && bounds.lo[axis] < bounds.hi[axis];
    images_[axis] = { periodic, box->vectors[axis][axis] };
    repeats_ = repeats_ ||
      (periodic && (grid.lo[axis] < bounds.lo[axis] || grid.hi[axis] > bounds.hi[axis]));
  }
}

/// The first and last that may reach into the grid.
std::array<std::int64_t, 2> GrainCells::images(
  std::size_t axis, double x, double radius) const noexcept
{
  if (!images_[axis].repeats)
  {
    return { 0, 0 };
  }
  constexpr double rounding = 1e-9; // an image too many is outside of all cells
  const double length = images_[axis].length.value();
  const double first = std::ceil((grid_.lo[axis] - x - radius) / length - rounding);
  const double last = std::floor((grid_.hi[axis] - x + radius) / length + rounding);
  return { static_cast<std::int64_t>(std::max(first, -most_images_of_axis)),
    static_cast<std::int64_t>(std::min(last, most_images_of_axis)) };
}

/// The coordinate of image k.
Twofold GrainCells::image(std::size_t axis, double x, std::int64_t k) const noexcept
{
  CompensatedSum sum;
  sum.add(x);
  sum.add_product(static_cast<double>(k), images_[axis].length);
  return k == 0 ? Twofold{ x, 0 } : sum.twofold();
}

std::int64_t GrainCells::most_images(double radius) const noexcept
{
  double all = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double reach = weights_ == CellWeights::Overlap ? 2 * radius : 0;
    const double extent = 1.001 * (grid_.spacing(axis) + reach);
    all *= images_[axis].repeats
      ? std::min(std::floor(extent / images_[axis].length.value()), 2 * most_images_of_axis) + 1
      : 1;
  }
  return static_cast<std::int64_t>(all);
}

void GrainCells::set_largest_volume(double largest_volume) noexcept
{
  constexpr int bits = 64;
  quantum_ = 0;
  if (weights_ == CellWeights::Overlap && largest_volume > 0)
  {
    double cell = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      cell *= grid_.spacing(axis) / 2; // one ulp may be missing of cells that are a few thick
    }
    const double ratio = std::min(cell / largest_volume, 1.0);
    quantum_ = (ratio > 0 ? std::max(std::ilogb(ratio), -500) : -500) - bits;
  }
  share_shift_ = std::ldexp(1.5, 52 + quantum_);
}
}
