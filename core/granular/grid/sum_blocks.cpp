// SPDX-License-Identifier: BSD-3-Clause
#include "granular/grid/sum_blocks.h"

#include <algorithm>

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
}
