// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_number_print_few_h
#define granular_numbers_number_print_few_h

// Numbers with few digits, and integers, where each instruction counts. Only for number_print.cpp and number_cells.cpp.

#include "granular/numbers/number_print_layout.h"

#include <array>
#include <bit>
#include <cstdint>

namespace granular::number_print
{
inline constexpr std::uint64_t sign_bit = std::uint64_t{ 1 } << 63;

inline const PowerOfFive& power_of_five(int q)
{
  return powers_of_five[static_cast<std::size_t>(q - smallest_power)];
}

inline constexpr auto whole_powers_of_ten = []
{
  std::array<std::uint64_t, 18> powers{};
  std::uint64_t power = 1;
  for (std::uint64_t& entry : powers)
  {
    entry = power;
    power *= 10;
  }
  return powers;
}();

inline std::uint64_t whole_power_of_ten(int q)
{
  return whole_powers_of_ten[static_cast<std::size_t>(q)];
}

/// Returns true if a number, finite and not small, is one that 10^q in the table can scale.
inline bool is_usual(std::uint64_t magnitude)
{
  constexpr std::uint64_t least = 60; // 2^-963
  return (magnitude >> 52) - least < 2047 - least;
}

/// A double times 10^q, as a product of which 64 bits are known.
struct Scaled
{
  std::uint64_t mantissa;
  std::uint64_t product; ///< the bits; the last `shift` of them, 7 to 63, are after the point
  int shift;
  int q;
};

/// A magnitude, not 0 and not small, made to have so many digits before the point.
///
/// With 10^q = g * 2^(binary_exponent(q) - 63), high of the table is in (g - 1, g + 2^-64]. So the
/// product is less than 2 below that of g, and not above it by 2^-63: a fraction of half - 1 or
/// half may be on either side of a half, or on it; all others are on their own.
inline Scaled scale(std::uint64_t magnitude, int digits)
{
  const std::uint64_t mantissa = magnitude << 11 | std::uint64_t{ 1 } << 63;
  const auto biased = static_cast<std::int64_t>(magnitude >> 52);
  constexpr std::int64_t log = 1292913986; // of 2, times 2^32
  const auto least = static_cast<std::int64_t>((biased * log - 1023 * log) >> 32);
  const std::int64_t q = digits - 1 - least -
    static_cast<std::int64_t>(
      magnitude >= least_doubles[static_cast<std::size_t>(least + 1 - smallest_normal_power)]);
  const Wide product =
    Wide{ mantissa } * powers_of_five[static_cast<std::size_t>(q - smallest_power)].high;
  return { mantissa, static_cast<std::uint64_t>(product >> 64),
    62 + 1023 - static_cast<int>(biased) - binary_exponent(static_cast<int>(q)),
    static_cast<int>(q) };
}

/// %g's choice.
inline Place place_of_digits(int k, int digits)
{
  return place_of(k, k >= least_fixed && k < digits);
}

/// A number rounded to some digits.
struct Rounded
{
  std::uint64_t whole; ///< the digits before the point, up to 10^digits
  int q;               ///< the number times 10^q
  bool sure;           ///< false: too near to a half
};

/// At most six digits, so that there are at least 44 bits after the point.
inline Rounded round_few(std::uint64_t magnitude, int digits)
{
  const Scaled scaled = scale(magnitude, digits);
  const std::uint64_t fraction = scaled.product << (-scaled.shift & 63);
  constexpr std::uint64_t doubt = std::uint64_t{ 1 } << 30; // much more than 2 units of the product
  return { (scaled.product >> (scaled.shift & 63)) + (fraction >> 63), scaled.q,
    fraction + doubt - (std::uint64_t{ 1 } << 63) >= 2 * doubt };
}

/// Lays out the sign of value and six digits, one per byte as of six_digits; the first has the weight 10^k. The precision of %g
/// decides whether an exponent is printed.
inline char* lay_out_six(char* to, double value, std::uint64_t digits, int k, int precision = 6)
{
  *to = '-';
  return lay_out_eight(
    to + (std::bit_cast<std::uint64_t>(value) >> 63), digits, place_of_digits(k, precision));
}

inline char* lay_out_few(char* to, double value, const Rounded& rounded, int digits)
{
  std::uint64_t whole = rounded.whole * whole_power_of_ten(6 - digits);
  int k = digits - 1 - rounded.q;
  if (whole == 1'000'000) [[unlikely]]
  {
    whole = 100'000;
    ++k;
  }
  return lay_out_six(to, value, six_digits(whole), k, digits);
}

/// x < 10^8 does it in one go.
inline char* print_natural(char* to, std::uint64_t x) noexcept
{
  if (x < 10)
  {
    *to = static_cast<char>('0' + x);
    return to + 1;
  }
  if (x < 100'000'000)
  {
    const std::uint64_t digits = eight_digits(x);
    const int zeros = std::countr_zero(digits) & ~7;
    store(to, (digits | eight_zeros) >> zeros);
    return to + 8 - (zeros >> 3);
  }
  to = print_natural(to, x / 100'000'000);
  store(to, eight_digits(x % 100'000'000) | eight_zeros);
  return to + 8;
}

/// Prints an integer as %d does, in up to most_number_chars bytes. The sign takes no branch: that of velocities and image counts is hard to foresee.
inline char* print_whole(char* to, std::int64_t value) noexcept
{
  const std::uint64_t negative = static_cast<std::uint64_t>(value) >> 63;
  *to = '-';
  return print_natural(
    to + negative, (static_cast<std::uint64_t>(value) ^ (0 - negative)) + negative);
}
}
#endif
