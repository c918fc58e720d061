// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_shares_h
#define granular_common_shares_h

#include <cstdint>
#include <numeric>
#include <span>

namespace granular
{
/// Returns where part `part` of `parts` begins among the rows: rows * part / parts, rounded down. part may be parts: the end
/// of the last. For rows up to 2^62.
inline std::int64_t begin_of_part(std::int64_t rows, int part, int parts) noexcept
{
  // of the rest, less than parts, the product fits
  return rows / parts * part + rows % parts * part / parts;
}

/// Returns the sum of counts, such as the rows of ranks.
inline std::int64_t sum_of(std::span<const std::int64_t> counts) noexcept
{
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{ 0 });
}
}
#endif
