// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_shares_h
#define granular_common_shares_h

#include <cstdint>

namespace granular
{
/// Returns where part `part` of `parts` begins among the rows: rows * part / parts, rounded down. part may be parts: the end
/// of the last. For rows up to 2^62.
inline std::int64_t begin_of_part(std::int64_t rows, int part, int parts) noexcept
{
  // of the rest, less than parts, the product fits
  return rows / parts * part + rows % parts * part / parts;
}
}
#endif
