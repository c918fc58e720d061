// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bonds_id_numbers_h
#define granular_bonds_id_numbers_h

#include <bit>
#include <cstdint>

namespace granular
{
/// Ids up to this magnitude are doubles of the same value: 2^53.
inline constexpr std::int64_t largest_id_value = std::int64_t{ 1 } << 53;

constexpr bool is_id_value(std::int64_t id) noexcept
{
  return id >= -largest_id_value && id <= largest_id_value;
}

/// Returns true if the double is an exact integer id (magnitude at most 2^53, not -0.0).
constexpr bool is_id_value(double number) noexcept
{
  constexpr auto largest = static_cast<double>(largest_id_value);
  constexpr auto minus_zero = std::uint64_t{ 1 } << 63;
  // The comparison is false of what is not a number, and the conversion then never done. With -fno-trapping-math GCC may make one
  // rounding of both conversions, which keeps the sign of -0.0: it is looked for by its bits.
  return number >= -largest && number <= largest &&
    static_cast<double>(static_cast<std::int64_t>(number)) == number &&
    std::bit_cast<std::uint64_t>(number) != minus_zero;
}

/// Returns an id as a double for a buffer: up to 2^53 as its value, as codes with 32-bit ids send it; beyond as its bits.
///
/// Some large ids have the bits of a double that is the value of a small id: 4607182418800017408 has those of 1. Such an id
/// changes places with the small one: it gets the bits of the integer 1, which no other id has. So each of the 2^64 ids has a
/// double of its own and comes back from it, and each double is an id. The double may be a signalling nan: copy it, do not
/// calculate.
constexpr double id_to_number(std::int64_t id) noexcept
{
  if (is_id_value(id))
  {
    return static_cast<double>(id);
  }
  const auto number = std::bit_cast<double>(id);
  return is_id_value(number) ? std::bit_cast<double>(static_cast<std::int64_t>(number)) : number;
}

/// Returns the id of such a double.
constexpr std::int64_t number_to_id(double number) noexcept
{
  if (is_id_value(number))
  {
    return static_cast<std::int64_t>(number);
  }
  const auto bits = std::bit_cast<std::int64_t>(number);
  return is_id_value(bits) ? std::bit_cast<std::int64_t>(static_cast<double>(bits)) : bits;
}
}
#endif
