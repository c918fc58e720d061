// SPDX-License-Identifier: BSD-3-Clause
#include "granular/sorting/block_rows.h"

#include <algorithm>
#include <numeric>

namespace granular
{
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
