// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_record_places_h
#define granular_restart_record_places_h

#include "granular/restart/bond_record.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

namespace granular
{
inline bool has_position_of(std::span<const double> part, std::span<const double> record) noexcept
{
  return std::memcmp(
           part.data() + RecordSlots::x, record.data() + RecordSlots::x, 3 * sizeof(double)) == 0;
}

/// Returns the type of a particle from either representation; 0 if invalid.
inline std::int64_t type_of(std::span<const double> part) noexcept
{
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  const double type = part[RecordSlots::type];
  const auto bits = std::bit_cast<std::int64_t>(type);
  const std::int64_t value =
    type >= 1 && type <= static_cast<double>(most) ? static_cast<std::int64_t>(type) : bits;
  return value >= 1 && value <= most ? value : 0;
}

/// Returns true if the data of an atom style may begin there.
inline bool begins_part(std::span<const double> record, std::size_t at) noexcept
{
  if (at > record.size() || record.size() - at < RecordSlots::common)
  {
    return false;
  }
  const auto part = record.subspan(at);
  return length_of(part[0], RecordSlots::common, part.size()) > 0 &&
    has_position_of(part, record) && type_of(part) > 0 && type_of(part) == type_of(record);
}

/// Calls take(part, begin, length) for the data of each fix. Returns false if the record has fewer fixes.
template <class Take>
bool walk_fixes(std::span<const double> record, std::size_t at, std::size_t fixes, const Take& take)
{
  for (std::size_t fix = 0; fix < fixes; ++fix)
  {
    const std::size_t length =
      at < record.size() ? length_of(record[at], 1, record.size() - at) : 0;
    if (length == 0)
    {
      return false;
    }
    take(fix, at, length);
    at += length;
  }
  return at == record.size();
}
}
#endif
