// SPDX-License-Identifier: BSD-3-Clause
#include "granular/sorting/exchange_rows.h"

#include "granular/common/shares.h"
#include "granular/parallel/trade.h"
#include "granular/sorting/find_ids_at.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>

namespace granular
{
namespace
{
/// Returns the numbers of the sorted ids of this rank that go to each rank.
std::vector<std::int64_t> count_parts(
  std::int64_t rows, std::span<const std::int64_t> sorted, Communicator& ranks)
{
  const auto size = static_cast<std::size_t>(ranks.size());
  std::vector<std::int64_t> places(size);
  std::vector<std::int64_t> begins(size);
  std::vector<std::int64_t> equal(size);
  for (int rank = 0; rank < ranks.size(); ++rank)
  {
    places[static_cast<std::size_t>(rank)] = begin_of_part(rows, rank, ranks.size());
  }
  const std::vector<std::int64_t> cuts = find_ids_at(places, sorted, ranks);
  for (std::size_t i = 0; i < size; ++i)
  {
    const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), cuts[i]);
    begins[i] = first - sorted.begin();
    equal[i] = last - first;
  }
  std::vector<std::int64_t> before = begins;
  ranks.sum(before);

  // the cut at which its part begins is drawn by each rank
  const auto own = static_cast<std::size_t>(ranks.rank());
  std::int64_t left = places[own] - before[own];
  std::vector<std::int64_t> shares = swap_numbers(equal, ranks);
  for (std::int64_t& share : shares)
  {
    share = std::min(share, left);
    left -= share;
  }
  shares = swap_numbers(shares, ranks);
  std::transform(begins.begin(), begins.end(), shares.begin(), begins.begin(), std::plus<>());

  std::vector<std::int64_t> counts(begins.begin() + 1, begins.end());
  counts.push_back(static_cast<std::int64_t>(sorted.size()));
  std::transform(counts.begin(), counts.end(), begins.begin(), counts.begin(), std::minus<>());
  return counts;
}
}

RowExchange::RowExchange(
  std::int64_t rows, std::span<const std::int64_t> sorted, Communicator& ranks)
  : ranks_(ranks)
  , out_(count_parts(rows, sorted, ranks))
  , in_(swap_numbers(out_, ranks))
  , rows_(std::accumulate(in_.begin(), in_.end(), std::int64_t{ 0 }))
{
}

void RowExchange::move(Block& block, std::size_t width, const RowOrder& leave,
  const RowOrder& arrive, const Executor& executor) const
{
  leave.apply(block, width, executor);
  Block came(static_cast<std::size_t>(rows_) * width, block.pool());
  ranks_.exchange(static_cast<const char*>(block.data()), to_bytes(out_, width),
    static_cast<char*>(came.data()), to_bytes(in_, width));
  block = std::exchange(came, Block());
  arrive.apply(block, width, executor);
}
}
