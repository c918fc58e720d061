// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_grid_sum_blocks_h
#define granular_grid_sum_blocks_h

#include "granular/grid/euler_grid.h"

#include <array>
#include <cstdint>

namespace granular
{
/// A grid divided into blocks of cells whose sums fit into the cache of a core.
class SumBlocks
{
public:
  static constexpr std::int64_t most_cells_of_block = 4096; ///< fits into 16 bits

  explicit SumBlocks(const std::array<std::int64_t, 3>& cells) noexcept;

  std::int64_t size() const noexcept { return blocks_[0] * blocks_[1] * blocks_[2]; }

  /// Returns the number of cells of the largest block.
  std::int64_t largest() const noexcept { return largest_; }

  CellRange range(std::int64_t block) const noexcept;

  /// Calls visit(block) for each block that contains cells of the range.
  template <class Visit>
  void each(const CellRange& range, const Visit& visit) const
  {
    CellRange blocks;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (range.first[axis] >= range.last[axis])
      {
        return;
      }
      blocks.first[axis] = range.first[axis] >> shifts_[axis];
      blocks.last[axis] = ((range.last[axis] - 1) >> shifts_[axis]) + 1;
    }
    blocks.each([&](const std::array<std::int64_t, 3>& at)
      { visit((at[2] * blocks_[1] + at[1]) * blocks_[0] + at[0]); });
  }

private:
  std::array<std::int64_t, 3> cells_;
  std::array<int, 3> shifts_ = {}; ///< edges are powers of two
  std::array<std::int64_t, 3> edges_ = {};
  std::array<std::int64_t, 3> blocks_ = {};
  std::int64_t largest_ = 1;
};
}
#endif
