// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_parallel_trade_h
#define granular_parallel_trade_h

#include "granular/common/pass.h"
#include "granular/common/shares.h"
#include "granular/parallel/communicator.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <ranges>
#include <string>
#include <vector>

namespace granular
{
/// Returns the value of every rank, by rank, on all ranks. Collective; for small data. A value consists of plain numbers,
/// which are sent as in memory, or is known to pass(archive, thing).
template <typename Thing>
std::vector<Thing> gather(Communicator& ranks, const Thing& own)
{
  ArchiveWriter packer;
  pass_item(packer, own);
  const std::vector<std::string> all = ranks.all_gather(packer.bytes);
  std::vector<Thing> things(all.size());
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    ArchiveReader unpacker(all[rank]);
    pass_item(unpacker, things[rank]);
  }
  return things;
}

/// Returns the bytes of so many items of a width.
inline std::vector<std::int64_t> to_bytes(std::vector<std::int64_t> counts, std::size_t width)
{
  for (std::int64_t& count : counts)
  {
    count *= static_cast<std::int64_t>(width);
  }
  return counts;
}

/// Sends out[r] items of so many values each to rank r, stored one rank after the other. Returns the received items, in[r] of
/// them from rank r, by rank. Collective.
template <class Values>
auto trade(const Values& values, const std::vector<std::int64_t>& out,
  const std::vector<std::int64_t>& in, Communicator& ranks, std::size_t width = 1)
{
  using Value = std::ranges::range_value_t<Values>;
  const auto all = sum_of(in);
  std::vector<Value> came(width * static_cast<std::size_t>(all));
  const std::size_t bytes = width * sizeof(Value);
  ranks.exchange(reinterpret_cast<const char*>(values.data()), to_bytes(out, bytes),
    reinterpret_cast<char*>(came.data()), to_bytes(in, bytes));
  return came;
}

/// Gives each rank its number. Returns the numbers for this rank, by rank. Collective.
inline std::vector<std::int64_t> swap_numbers(
  const std::vector<std::int64_t>& numbers, Communicator& ranks)
{
  const std::vector<std::int64_t> one_each(numbers.size(), 1);
  return trade(numbers, one_each, one_each, ranks);
}

/// Things in the order of the ranks that they go to.
struct ByRank
{
  std::vector<std::int64_t> counts; ///< for each rank
  std::vector<std::int64_t> places; ///< of each, where it was before
};

/// Sorts `count` things by rank; things of the same rank keep their order. rank_of gives the rank of a thing, or the number
/// of ranks for a thing that is left out.
template <class RankOf>
ByRank sort_by_rank(std::size_t count, std::size_t ranks, const RankOf& rank_of)
{
  ByRank sorted;
  sorted.counts.assign(ranks + 1, 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    ++sorted.counts[rank_of(i)];
  }
  std::vector<std::int64_t> next(ranks + 1);
  std::exclusive_scan(sorted.counts.begin(), sorted.counts.end(), next.begin(), std::int64_t{ 0 });
  const std::int64_t left_out = sorted.counts[ranks];
  sorted.counts.pop_back();
  sorted.places.resize(count - static_cast<std::size_t>(left_out));
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t rank = rank_of(i);
    if (rank < ranks)
    {
      sorted.places[static_cast<std::size_t>(next[rank]++)] = static_cast<std::int64_t>(i);
    }
  }
  return sorted;
}

/// Returns the values at some places.
template <class Values>
auto pick(const Values& from, const std::vector<std::int64_t>& places)
{
  std::vector<std::ranges::range_value_t<Values>> picked(places.size());
  std::ranges::transform(places, picked.begin(),
    [&](std::int64_t place) { return from[static_cast<std::size_t>(place)]; });
  return picked;
}
}
#endif
