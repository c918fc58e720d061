// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_parallel_trade_h
#define granular_parallel_trade_h

#include "granular/parallel/communicator.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <ranges>
#include <vector>

namespace granular
{
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
  const auto all = std::accumulate(in.begin(), in.end(), std::int64_t{ 0 });
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
}
#endif
