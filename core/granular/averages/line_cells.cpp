// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/line_cells.h"

namespace granular
{
namespace
{
double rounded(double place) noexcept
{
  constexpr double shift = 1.5 / 2; // of numbers up to 1: what is added has no bits below 2^-53
  return place + shift - shift;
}
}

LineCells::LineCells(const EulerGrid& grid, const WeightOptions& options, const Box* box)
  : grid_(grid)
  , finder_(grid)
  , images_(grid, box)
{
  if (options.weights == CellWeights::Kernel)
  {
    smooth_.emplace(grid_, Kernel(options.kernel, options.width), options.bounds, images_);
  }
}

std::int64_t LineCells::check(double length) const
{
  if (smooth_)
  {
    smooth_->check(length);
  }
  const double reach =
    smooth_ ? std::ranges::max(smooth_->reach({ length, length, length })) : length / 2;
  images_.check(reach);
  return images_.most_in_cell(reach);
}

CellRange LineCells::range(const Vector3& start, const Vector3& branch) const noexcept
{
  CellRange range;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double end = start[axis] + branch[axis];
    const double lo = std::min(start[axis], end);
    const double hi = std::max(start[axis], end);
    if (!(hi >= grid_.lo[axis] && lo <= grid_.hi[axis]))
    {
      return {};
    }
    // an ulp more on both sides: the middle of a part is rounded
    const double slack = 0x1p-50 * std::max(std::abs(lo), std::abs(hi));
    range.first[axis] = finder_.find(axis, std::clamp(lo - slack, grid_.lo[axis], grid_.hi[axis]));
    range.last[axis] =
      finder_.find(axis, std::clamp(hi + slack, grid_.lo[axis], grid_.hi[axis])) + 1;
  }
  return range;
}

void LineCells::find_cuts(
  const Vector3& start, const Vector3& branch, std::vector<double>& cuts) const
{
  const CellRange cells = this->range(start, branch);
  cuts.assign({ 0.0, 1.0 });
  for (std::size_t axis = 0; cells.size() > 0 && axis < 3; ++axis)
  {
    for (std::int64_t face = cells.first[axis]; face <= cells.last[axis]; ++face)
    {
      const double place = (grid_.face(axis, face) - start[axis]) / branch[axis];
      if (place > 0 && place < 1)
      {
        cuts.push_back(rounded(place));
      }
    }
  }
  std::ranges::sort(cuts);
}
}
