// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_euler_cell_blocks_h
#define granular_formats_euler_cell_blocks_h

#include "granular/formats/euler/euler_file.h"
#include "granular/geometry/box.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

namespace granular
{
/// Finds how many places lie at equal distances.
class EqualSteps
{
public:
  EqualSteps(double first, double tolerance) noexcept
    : first_(first)
    , tolerance_(tolerance)
  {
  }

  /// Returns true if this place continues the sequence.
  bool add(double place) noexcept
  {
    ++steps_;
    least_ = std::max(least_, (place - first_ - tolerance_) / steps_);
    most_ = std::min(most_, (place - first_ + tolerance_) / steps_);
    return least_ <= most_;
  }

private:
  double first_;
  double tolerance_;
  double steps_ = 0;
  double least_ = 0; ///< distances that fit all
  double most_ = std::numeric_limits<double>::infinity();
};

/// Consecutive cells that form a grid, x fastest.
struct CellBlock
{
  std::int64_t first = 0;
  std::array<std::int64_t, 3> counts = {};
};

/// Divides the cells of a frame into blocks, by their centres.
class CellBlocks
{
public:
  /// Throws UnsupportedError if a centre is not finite.
  explicit CellBlocks(const EulerFrame& frame);

  /// Returns the largest block that begins with a cell.
  CellBlock block(std::int64_t first) const;

  /// Returns a coordinate of a cell's centre.
  double at(std::int64_t cell, std::size_t axis) const noexcept
  {
    return frame_.centres[static_cast<std::size_t>(3 * cell) + axis];
  }

  /// Returns the tolerance for distances equal to spacing.
  double tolerance(std::size_t axis, double spacing) const noexcept
  {
    return std::min(tolerances_[axis], spacing / 4);
  }

  /// Throws UnsupportedError: the cell belongs to no grid.
  [[noreturn]] void fail(std::int64_t cell, const std::string& why) const;

private:
  double rounding(std::size_t axis) const;
  std::int64_t run(std::int64_t first, std::size_t axis, std::int64_t stride) const;
  bool goes_on(std::int64_t first, std::size_t axis, std::int64_t stride, std::int64_t slab) const;
  bool is_alone(std::int64_t first, std::size_t axis, std::int64_t stride) const;

  const EulerFrame& frame_;
  Vector3 tolerances_ = {};
};
}
#endif
