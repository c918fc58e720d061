// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_euler_sum_blocks_h
#define granular_euler_sum_blocks_h

#include "granular/euler/euler_grid.h"
#include "granular/euler/sphere_cells.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

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

/// The rows that contribute to each block. A row may be in several blocks.
class BlockRows
{
public:
  /// A row of a chunk, and a block.
  struct Entry
  {
    std::uint32_t block;
    std::uint32_t row; ///< less the first of the chunk

    bool operator==(const Entry&) const = default;
  };

  /// Returns the lists for a single block, which has all rows.
  static BlockRows all(std::int64_t rows);

  /// Sorts the entries of all chunks by block. Each chunk has this many rows; the entries are freed on the way.
  static BlockRows sorted(
    std::vector<std::vector<Entry>>& chunks, std::int64_t rows_of_chunk, std::int64_t blocks);

  /// Returns the number of entries of all blocks.
  std::int64_t size() const noexcept { return starts_.back(); }

  /// Returns the index of the block's first entry.
  std::int64_t start(std::int64_t block) const noexcept
  {
    return starts_[static_cast<std::size_t>(block)];
  }
  std::int64_t count(std::int64_t block) const noexcept
  {
    return this->start(block + 1) - this->start(block);
  }

  /// Returns entries [first, last) of a block as rows, at most as many as the buffer holds.
  std::span<const std::int64_t> rows(std::int64_t block, std::int64_t first, std::int64_t last,
    std::span<std::int64_t> buffer) const noexcept;

private:
  std::vector<std::int64_t> starts_; ///< blocks + 1
  std::vector<std::int64_t> rows_;   ///< empty: those of the only block, from 0
};
}
#endif
