// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_parallel_by_rank_h
#define granular_parallel_by_rank_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <ranges>
#include <vector>

namespace granular
{
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
