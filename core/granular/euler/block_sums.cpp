// SPDX-License-Identifier: BSD-3-Clause
#include "granular/euler/block_sums.h"

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

BlockSums::BlockSums(
  const EulerGrid& grid, Communicator& ranks, const Executor& executor, Progress& progress)
  : blocks_(grid.counts)
  , ranks_(ranks)
  , executor_(executor)
  , progress_(progress)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::vector<double> faces = grid.faces(axis);
    edges_[axis].resize(faces.size() - 1);
    std::transform(
      faces.begin() + 1, faces.end(), faces.begin(), edges_[axis].begin(), std::minus<>());
  }
}

void BlockSums::set_rows(BlockRows rows)
{
  rows_ = std::move(rows);
  counts_.resize(static_cast<std::size_t>(blocks_.size()));
  for (std::size_t block = 0; block < counts_.size(); ++block)
  {
    counts_[block] = rows_.count(static_cast<std::int64_t>(block));
  }
  ranks_.sum(counts_);
}

std::vector<BlockSums::Group> BlockSums::make_groups(std::size_t largest_scale) const
{
  const std::int64_t block_bytes = blocks_.largest() * 8 * static_cast<std::int64_t>(largest_scale);
  // one process alone does better with what fits into caches
  const std::int64_t bytes = ranks_.size() > 1
    ? bytes_of_group
    : std::min<std::int64_t>(bytes_of_group, bytes_of_thread * executor_.threads());
  const std::int64_t together = std::max<std::int64_t>(bytes / block_bytes, 1);
  const auto threads = static_cast<std::int64_t>(executor_.threads());
  std::vector<Group> groups;
  for (std::int64_t first = 0; first < blocks_.size(); first += together)
  {
    const std::int64_t last = std::min(first + together, blocks_.size());
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
