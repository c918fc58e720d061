// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/euler/cell_blocks.h"

#include "granular/numbers/number_print.h"

#include <cmath>

namespace granular
{
namespace
{
bool is_single(double value)
{
  return static_cast<double>(static_cast<float>(value)) == value;
}

bool has_six_digits(double value)
{
  return as_printed(value, { 6 }) == value;
}

bool has_six_decimals(double value)
{
  return as_fixed(value) == value;
}
}

CellBlocks::CellBlocks(const EulerFrame& frame)
  : frame_(frame)
{
  for (std::int64_t cell = 0; cell < frame.cells; ++cell)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (!std::isfinite(this->at(cell, axis)))
      {
        this->fail(cell, ", which is nowhere");
      }
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    tolerances_[axis] = this->rounding(axis);
  }
}

/// Returns the possible error in the distance of two centres: LIGGGHTS prints six decimals; somebody may since have stored them
/// in single precision, or printed six digits, as VTK does. Of other numbers only the last bits may.
double CellBlocks::rounding(std::size_t axis) const
{
  bool single = true;
  bool six_digits = true;
  bool six_decimals = true;
  double largest = 0;
  double last = 0;
  for (std::int64_t cell = 0; cell < frame_.cells; ++cell)
  {
    const double value = this->at(cell, axis);
    if (value != last)
    {
      single = single && is_single(value);
      six_digits = six_digits && has_six_digits(value);
      six_decimals = six_decimals && has_six_decimals(value);
      largest = std::max(largest, std::abs(value));
      last = value;
    }
  }
  const double of_single = single ? largest * 0x1p-23 : 0;
  const double of_digits =
    six_digits && largest > 0 ? std::pow(10, std::floor(std::log10(largest)) - 5) : 0;
  const double of_decimals = six_decimals ? 1e-6 : 0;
  return std::max({ of_decimals, of_single, of_digits, largest * 0x1p-49 });
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

/// Returns the number of slabs, of that many cells each, that follow one another along an axis at equal distances.
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

/// Returns true if a slab is the first one of all, moved along the axis beyond the one before. What is the same is printed the
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

/// Returns true if the first slab is a grid of its own, and at least three of another follow: those have the same distances,
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
