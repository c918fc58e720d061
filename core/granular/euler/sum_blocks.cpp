// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/sum_blocks.h"

#include <algorithm>
#include <numeric>

namespace granular
{
SumBlocks::SumBlocks(const std::array<std::int64_t, 3>& cells) noexcept
  : cells_(cells)
  , edges_{ 1, 1, 1 }
{
  // as near to cubes as the grid allows: spheres touch few of them
  const auto grows = [this](std::size_t axis) { return edges_[axis] < cells_[axis]; };
  const auto is_shorter = [&](std::size_t a, std::size_t b)
  { return grows(a) && (!grows(b) || edges_[a] < edges_[b]); };
  for (std::int64_t size = 1; size < most_cells_of_block; size *= 2)
  {
    const std::size_t shortest = std::min<std::size_t>({ 0, 1, 2 }, is_shorter);
    if (!grows(shortest))
    {
      break;
    }
    edges_[shortest] *= 2;
    ++shifts_[shortest];
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    blocks_[axis] = (cells_[axis] + edges_[axis] - 1) / edges_[axis];
    largest_ *= std::min(edges_[axis], cells_[axis]);
  }
}

CellRange SumBlocks::range(std::int64_t block) const noexcept
{
  const std::array<std::int64_t, 3> at = { block % blocks_[0], block / blocks_[0] % blocks_[1],
    block / blocks_[0] / blocks_[1] };
  CellRange range;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    range.first[axis] = at[axis] * edges_[axis];
    range.last[axis] = std::min(range.first[axis] + edges_[axis], cells_[axis]);
  }
  return range;
}

BlockRows BlockRows::all(std::int64_t rows)
{
  BlockRows all;
  all.starts_ = { 0, rows };
  return all;
}

BlockRows BlockRows::sorted(
  std::vector<std::vector<Entry>>& chunks, std::int64_t rows_of_chunk, std::int64_t blocks)
{
  BlockRows sorted;
  sorted.starts_.resize(static_cast<std::size_t>(blocks) + 1);
  for (const std::vector<Entry>& chunk : chunks)
  {
    for (const Entry& entry : chunk)
    {
      ++sorted.starts_[entry.block + 1];
    }
  }
  std::partial_sum(sorted.starts_.begin(), sorted.starts_.end(), sorted.starts_.begin());
  sorted.rows_.resize(static_cast<std::size_t>(sorted.starts_.back()));
  std::vector<std::int64_t> next(sorted.starts_.begin(), sorted.starts_.end() - 1);
  std::int64_t first = 0;
  for (std::vector<Entry>& chunk : chunks)
  {
    for (const Entry& entry : chunk)
    {
      sorted.rows_[static_cast<std::size_t>(next[entry.block]++)] = first + entry.row;
    }
    std::vector<Entry>().swap(chunk);
    first += rows_of_chunk;
  }
  return sorted;
}

std::span<const std::int64_t> BlockRows::rows(std::int64_t block, std::int64_t first,
  std::int64_t last, std::span<std::int64_t> buffer) const noexcept
{
  const std::int64_t start = this->start(block) + first;
  const auto count =
    std::min(static_cast<std::size_t>(std::max<std::int64_t>(last - first, 0)), buffer.size());
  if (!rows_.empty())
  {
    return std::span(rows_).subspan(static_cast<std::size_t>(start), count);
  }
  std::iota(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(count), start);
  return buffer.first(count);
}
}
