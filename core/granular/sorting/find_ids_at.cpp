// SPDX-License-Identifier: BSD-3-Clause
#include "granular/sorting/find_ids_at.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>

namespace granular
{
std::vector<std::int64_t> find_ids_at(const std::vector<std::int64_t>& places,
  std::span<const std::int64_t> sorted, Communicator& ranks)
{
  std::vector<std::int64_t> low(places.size(), std::numeric_limits<std::int64_t>::min());
  std::vector<std::int64_t> high(places.size(), std::numeric_limits<std::int64_t>::max());
  std::vector<std::int64_t> up_to(places.size());
  while (low != high)
  {
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const auto end =
        std::upper_bound(sorted.begin(), sorted.end(), std::midpoint(low[i], high[i]));
      up_to[i] = end - sorted.begin();
    }
    ranks.sum(up_to);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const std::int64_t middle = std::midpoint(low[i], high[i]);
      (up_to[i] > places[i] ? high[i] : low[i]) = up_to[i] > places[i] ? middle : middle + 1;
    }
  }
  return low;
}
}
