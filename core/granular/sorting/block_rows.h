// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_sorting_block_rows_h
#define granular_sorting_block_rows_h

#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
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
