// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/block_sums.h"

#include <utility>

namespace granular
{
namespace
{
/// Size of the sums of a group, where there is one process.
constexpr std::int64_t bytes_of_thread = std::int64_t{ 2 } << 20;

/// Below it the parts of a block are not worth a sum of their own each.
constexpr std::int64_t rows_of_part = 16384;
}

BlockSums::BlockSums(const EulerGrid& grid, const WantedCells& wanted, Communicator& ranks,
  const Executor& executor, Progress& progress)
  : grid_(grid)
  , wanted_(wanted)
  , ranks_(ranks)
  , executor_(executor)
  , progress_(progress)
{
  // as near to cubes as the grid allows: spheres touch few of them
  const auto edge = [&](std::size_t axis) { return std::int64_t{ 1 } << shifts_[axis]; };
  const auto grows = [&](std::size_t axis) { return edge(axis) < grid.counts[axis]; };
  const auto is_shorter = [&](std::size_t a, std::size_t b)
  { return grows(a) && (!grows(b) || edge(a) < edge(b)); };
  for (std::int64_t size = 1; size < most_cells_of_block; size *= 2)
  {
    const std::size_t shortest = std::min<std::size_t>({ 0, 1, 2 }, is_shorter);
    if (!grows(shortest))
    {
      break;
    }
    ++shifts_[shortest];
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    blocks_[axis] = (grid.counts[axis] + edge(axis) - 1) / edge(axis);
    largest_ *= std::min(edge(axis), grid.counts[axis]);
    const std::vector<double> faces = grid.faces(axis);
    edges_[axis].resize(faces.size() - 1);
    std::transform(
      faces.begin() + 1, faces.end(), faces.begin(), edges_[axis].begin(), std::minus<>());
  }
}

CellRange BlockSums::range(std::int64_t block) const noexcept
{
  const std::array<std::int64_t, 3> at = { block % blocks_[0], block / blocks_[0] % blocks_[1],
    block / blocks_[0] / blocks_[1] };
  CellRange range;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    range.first[axis] = at[axis] << shifts_[axis];
    range.last[axis] = std::min((at[axis] + 1) << shifts_[axis], grid_.counts[axis]);
  }
  return range;
}

double BlockSums::volume_of(const std::array<std::int64_t, 3>& cell) const noexcept
{
  const auto [x, y, z] = cell;
  return edges_[0][static_cast<std::size_t>(x)] * edges_[1][static_cast<std::size_t>(y)] *
    edges_[2][static_cast<std::size_t>(z)];
}

void BlockSums::set_rows(BlockRows rows)
{
  rows_ = std::move(rows);
  counts_.resize(static_cast<std::size_t>(this->blocks()));
  for (std::size_t block = 0; block < counts_.size(); ++block)
  {
    counts_[block] = rows_.count(static_cast<std::int64_t>(block));
  }
  ranks_.sum(counts_);
}

std::vector<BlockSums::Group> BlockSums::make_groups(std::size_t largest_scale) const
{
  const std::int64_t block_bytes = largest_ * 8 * static_cast<std::int64_t>(largest_scale);
  // one process alone does better with what fits into caches
  const std::int64_t bytes = ranks_.size() > 1
    ? bytes_of_group
    : std::min<std::int64_t>(bytes_of_group, bytes_of_thread * executor_.threads());
  const std::int64_t together = std::max<std::int64_t>(bytes / block_bytes, 1);
  const auto threads = static_cast<std::int64_t>(executor_.threads());
  std::vector<Group> groups;
  for (std::int64_t first = 0; first < this->blocks(); first += together)
  {
    const std::int64_t last = std::min(first + together, this->blocks());
    const std::int64_t rows =
      std::accumulate(counts_.begin() + first, counts_.begin() + last, std::int64_t{ 0 });
    if (rows > 0)
    {
      groups.push_back({ first, last,
        last - first >= 2 * threads ? 1
                                    : std::clamp<std::int64_t>(rows / rows_of_part, 1, threads) });
    }
  }
  return groups;
}
}
