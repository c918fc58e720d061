// SPDX-License-Identifier: BSD-3-Clause
#include "granular/grid/periodic_images.h"

#include "granular/common/error.h"
#include "granular/numbers/number_print.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <cmath>

namespace granular
{
namespace
{
/// Images of a particle, in the grid and in a cell: more are no scene.
constexpr double most_in_grid = 1e6;
constexpr double most_in_one_cell = 1000;

/// Part of the length of the box: an image too many is outside of all cells.
constexpr double rounding = 1e-9;
}

PeriodicImages::PeriodicImages(const EulerGrid& grid, const Box* box)
  : grid_(grid)
{
  if (!box || box->general)
  {
    return;
  }
  vectors_ = box->vectors;
  const BoxBounds bounds = box->bounds();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Twofold length = box->vectors[axis][axis];
    const bool repeats =
      is_periodic(*box, axis) && bounds.lo[axis] < bounds.hi[axis] && length.value() > 0;
    const double margin = rounding * length.value();
    Expansion<4> rest; // of the grid beyond a period: exact, as grids often are a period long
    rest.add(grid.hi[axis]);
    rest.add(-grid.lo[axis]);
    rest.add(Twofold{ -length.hi, -length.lo });
    const bool wraps = repeats && rest.sign() >= 0;
    axes_[axis] = { repeats, wraps, length, grid.hi[axis] - length.value() + margin,
      grid.lo[axis] + length.value() - margin };
    tilted_ = tilted_ || (repeats && box->tilted);
    of_centres_ = of_centres_ || tilted_ ||
      (repeats && (grid.lo[axis] < bounds.lo[axis] || grid.hi[axis] > bounds.hi[axis]));
  }
}

std::array<std::int64_t, 2> PeriodicImages::find_range(
  std::size_t axis, double x, double radius) const noexcept
{
  const double length = axes_[axis].length.value();
  const double first = std::ceil((grid_.lo[axis] - x - radius) / length - rounding);
  const double last = std::floor((grid_.hi[axis] - x + radius) / length + rounding);
  constexpr double most = 0x1p62; // so far away images coincide
  return { static_cast<std::int64_t>(std::clamp(first, -most, most)),
    static_cast<std::int64_t>(std::clamp(last, -most, most)) };
}

Twofold PeriodicImages::moved(
  std::size_t axis, double x, const std::array<std::int64_t, 3>& k) const noexcept
{
  Expansion<13> sum;
  sum.add(x);
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (k[i] != 0 && vectors_[i][axis].hi != 0) // most are 0
    {
      sum.add_product(static_cast<double>(k[i]), vectors_[i][axis]);
    }
  }
  return sum.twofold();
}

std::int64_t PeriodicImages::most_in_cell(double radius) const noexcept
{
  double all = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double extent = 1.001 * (grid_.spacing(axis) + 2 * radius);
    all *= axes_[axis].repeats ? std::floor(extent / axes_[axis].length.value()) + 1 : 1;
  }
  return static_cast<std::int64_t>(std::min(all, 2 * most_in_one_cell));
}

void PeriodicImages::check(double radius) const
{
  double images = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double length = axes_[axis].length.value();
    const double farthest = std::max(std::abs(grid_.lo[axis]), std::abs(grid_.hi[axis]));
    if (axes_[axis].repeats)
    {
      // of places far away nobody could tell the periods
      images *= farthest / length < 0x1p50
        ? (grid_.hi[axis] - grid_.lo[axis] + 2 * radius) / length + 1
        : most_in_grid + 1;
    }
  }
  if (images > most_in_grid || static_cast<double>(this->most_in_cell(radius)) > most_in_one_cell)
  {
    throw LimitError("expected cells and grains that are not much larger than the periodic box, or "
                     "far away from it: a grain of radius " +
      to_text(radius) + " would have too many images");
  }
}
}
