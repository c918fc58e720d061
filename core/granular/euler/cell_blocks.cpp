// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/cell_blocks.h"

#include "granular/base/number_print.h"

#include <cmath>

namespace granular
{
CellBlocks::CellBlocks(const EulerFrame& frame, double rounding)
  : frame_(frame)
{
  constexpr double six_decimals = 1e-6; // of two centres, for their distance
  Vector3 largest = {};
  for (std::int64_t cell = 0; cell < frame.cells; ++cell)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (!std::isfinite(this->at(cell, axis)))
      {
        this->fail(cell, ", which is nowhere");
      }
      largest[axis] = std::max(largest[axis], std::abs(this->at(cell, axis)));
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    tolerances_[axis] = six_decimals + rounding * largest[axis];
  }
}

void CellBlocks::fail(std::int64_t cell, const std::string& why) const
{
  throw UnsupportedError(
    "expected cells that form a regular grid, or one for each process, got cell " +
    std::to_string(cell) + " at " + to_text(this->at(cell, 0)) + " " + to_text(this->at(cell, 1)) +
    " " + to_text(this->at(cell, 2)) + why);
}

CellBlock CellBlocks::block(std::int64_t first) const
{
  CellBlock block = { first, {} };
  std::int64_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    block.counts[axis] = this->run(first, axis, stride);
    stride *= block.counts[axis];
  }
  return block;
}

/// How many slabs, of that many cells each, follow one another along an axis at equal distances.
std::int64_t CellBlocks::run(std::int64_t first, std::size_t axis, std::int64_t stride) const
{
  if (!this->goes_on(first, axis, stride, 1) || this->is_alone(first, axis, stride))
  {
    return 1;
  }
  const double start = this->at(first, axis);
  EqualSteps steps(start, this->tolerance(axis, this->at(first + stride, axis) - start));
  std::int64_t slab = 1;
  while (
    this->goes_on(first, axis, stride, slab) && steps.add(this->at(first + slab * stride, axis)))
  {
    ++slab;
  }
  return slab;
}

/// Whether a slab is the first one of all, moved along the axis beyond the one before. What is the same is printed the
/// same.
bool CellBlocks::goes_on(
  std::int64_t first, std::size_t axis, std::int64_t stride, std::int64_t slab) const
{
  const std::int64_t begin = first + slab * stride;
  if (frame_.cells - begin < stride || !(this->at(begin, axis) > this->at(begin - stride, axis)))
  {
    return false;
  }
  for (std::int64_t i = 0; i < stride; ++i)
  {
    for (std::size_t other = 0; other < 3; ++other)
    {
      if (this->at(begin + i, other) != this->at(other == axis ? begin : first + i, other))
      {
        return false;
      }
    }
  }
  return true;
}

/// Whether the first slab is a grid of its own, and at least three of another follow: those have the same distances,
/// the first one has another.
bool CellBlocks::is_alone(std::int64_t first, std::size_t axis, std::int64_t stride) const
{
  if (!this->goes_on(first, axis, stride, 2) || !this->goes_on(first, axis, stride, 3))
  {
    return false;
  }
  Vector3 steps;
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    const std::int64_t from = first + static_cast<std::int64_t>(i) * stride;
    steps[i] = this->at(from + stride, axis) - this->at(from, axis);
  }
  const auto differ = [&](double a, double b)
  { return std::abs(a - b) > 2 * this->tolerance(axis, std::min(a, b)); };
  return differ(steps[0], steps[1]) && !differ(steps[1], steps[2]);
}
}
