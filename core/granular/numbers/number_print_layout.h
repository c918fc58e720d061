// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_number_print_layout_h
#define granular_numbers_number_print_layout_h

// Conversion of digits to text with as few branches as possible. Only for number_print.cpp and number_cells.cpp.

#include "granular/numbers/decimal.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace granular::number_print
{
__extension__ using Wide = unsigned __int128;

inline constexpr std::uint64_t eight_zeros = 0x3030303030303030;

/// Returns the digits of x < 10^8, one per byte, the first in the lowest byte: splits into halves, quarters and eighths
/// in parallel. The reciprocals are exact in their range: x < 10^4 by 100, x < 100 by 10.
inline std::uint64_t eight_digits(std::uint64_t x)
{
  const std::uint64_t high = x * 3518437209 >> 45; // x / 10^4
  const std::uint64_t halves = (x << 32) - high * ((std::uint64_t{ 10000 } << 32) - 1);
  const std::uint64_t hundreds = ((halves * 10486) >> 20) & 0x7f0000007f;
  const std::uint64_t pairs = (halves << 16) - hundreds * ((100 << 16) - 1);
  const std::uint64_t tens = ((pairs * 103) >> 10) & 0x000f000f000f000f;
  return (pairs << 8) - tens * ((10 << 8) - 1);
}

/// Returns the number of digits, of eight, up to the last non-zero one; at least one.
inline unsigned significant(std::uint64_t digits)
{
  const std::uint64_t reversed = __builtin_bswap64(digits) | std::uint64_t{ 1 } << 63;
  return 8 - (static_cast<unsigned>(std::countr_zero(reversed)) >> 3);
}

/// The digits of numbers below 1000.
inline constexpr auto three_digits = []
{
  std::array<std::uint32_t, 1000> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i)
  {
    table[i] = i / 100 | i / 10 % 10 << 8 | i % 10 << 16;
  }
  return table;
}();

/// Returns the digits of x < 10^6, and two zeros.
inline std::uint64_t six_digits(std::uint64_t x)
{
  const std::uint64_t high = x * 1073742 >> 30; // x / 1000
  return three_digits[high] | std::uint64_t{ three_digits[x - high * 1000] } << 24;
}

/// Stores eight characters; the first is in the lowest byte.
inline void store(char* to, std::uint64_t eight_chars)
{
  if constexpr (std::endian::native == std::endian::big)
  {
    eight_chars = __builtin_bswap64(eight_chars);
  }
  std::memcpy(to, &eight_chars, sizeof eight_chars);
}

/// Offsets are in characters, from the first after the sign.
struct Layout
{
  std::uint8_t start;    ///< of the digits, after "0.000"
  std::uint8_t shift;    ///< 8 * digits between the first and the point
  std::uint8_t point;    ///< where a point goes, seen or not
  std::uint8_t tail;     ///< where the digits after the point go
  std::uint8_t tail_end; ///< where the last eight of sixteen of them go
  std::uint8_t before;   ///< digits before the point; many: the point is in front of them all
  std::uint8_t least;    ///< digits that are printed even if they are 0
};

inline constexpr int least_fixed = -4; // %g prints smaller numbers with an exponent
inline constexpr int smallest_exponent = -324;

/// The layouts of numbers printed without an exponent, by decimal exponent.
inline constexpr auto layouts = []
{
  std::array<Layout, 17 - least_fixed> table{};
  for (int k = least_fixed; k <= 16; ++k)
  {
    const auto byte = [](int n) { return static_cast<std::uint8_t>(n); };
    Layout& layout = table[static_cast<std::size_t>(k - least_fixed)];
    if (k < 0) // the tail is printed to where it is anyway
    {
      layout = { byte(1 - k), 0, 1, byte(2 - k), byte(10 - k), 255, 0 };
    }
    else if (k < 16)
    {
      // without room for the last eight digits, none of them is shown
      layout = { 0, byte(8 * k), byte(k + 1), byte(k + 2), byte(k < 8 ? k + 10 : 17), byte(k + 1),
        byte(k + 1) };
    }
    else // 17 digits and no point
    {
      layout = { 0, 0, 17, 1, 9, 17, 17 };
    }
  }
  return table;
}();

/// The exponents: "e-05" in the lower bytes, its length in the highest byte. The first entry is empty.
inline constexpr auto exponents = []
{
  std::array<std::uint64_t, 2 + largest_power - smallest_exponent> table{};
  for (int k = smallest_exponent; k <= largest_power; ++k)
  {
    const auto size = static_cast<unsigned>(k < 0 ? -k : k);
    std::uint64_t text = 'e' | (k < 0 ? std::uint64_t{ '-' } : std::uint64_t{ '+' }) << 8;
    int length = 2;
    for (unsigned unit = size >= 100 ? 100 : 10; unit > 0; unit /= 10, ++length)
    {
      text |= std::uint64_t{ '0' + size / unit % 10 } << (8 * length);
    }
    table[static_cast<std::size_t>(k - smallest_exponent + 1)] =
      text | static_cast<std::uint64_t>(length) << 56;
  }
  return table;
}();

struct Place
{
  const Layout& layout;
  std::uint64_t exponent;
};

/// Returns the place of a number whose first digit has the weight 10^k.
inline Place place_of(int k, bool fixed)
{
  return { layouts[static_cast<std::size_t>((fixed ? k : 0) - least_fixed)],
    exponents[fixed ? 0 : static_cast<std::size_t>(k - smallest_exponent + 1)] };
}

/// Writes the characters around the digits; `length` is the number of digits without trailing zeros.
inline char* finish(char* to, const Place& place, unsigned length)
{
  to[place.layout.point] = '.';
  length += length > place.layout.before ? 1 : 0;
  length = length > place.layout.least ? length : place.layout.least;
  char* const end = to + place.layout.start + length;
  store(end, place.exponent);
  return end + (place.exponent >> 56);
}

inline constexpr std::uint64_t zeros_and_point = '0' | '.' << 8 | eight_zeros << 16;

/// Lays out eight digits.
inline char* lay_out_eight(char* to, std::uint64_t raw, const Place& place)
{
  store(to, zeros_and_point);
  store(to + place.layout.start, raw | eight_zeros);
  store(to + place.layout.tail, (raw | eight_zeros) >> 8 >> place.layout.shift);
  return finish(to, place, significant(raw));
}

/// Seventeen digits: one, and two groups of eight.
struct Seventeen
{
  std::uint64_t first;
  std::uint64_t high;
  std::uint64_t low;

  unsigned length() const
  {
    const unsigned upper = high != 0 ? 1 + significant(high) : 1;
    return low != 0 ? 9 + significant(low) : upper;
  }
};

inline Seventeen seventeen_digits(std::uint64_t x)
{
  const std::uint64_t first = x / 10'000'000'000'000'000;
  const std::uint64_t after = x - first * 10'000'000'000'000'000;
  const std::uint64_t half = after / 100'000'000;
  return { first, eight_digits(half), eight_digits(after - half * 100'000'000) };
}

inline char* lay_out_seventeen(char* to, const Seventeen& raw, const Place& place)
{
  const std::uint64_t high = raw.high | eight_zeros;
  const std::uint64_t low = raw.low | eight_zeros;
  store(to, zeros_and_point);
  char* const start = to + place.layout.start;
  *start = static_cast<char>('0' + raw.first);
  store(start + 1, high);
  store(start + 9, low);
  const Wide tail = (Wide{ low } << 64 | high) >> place.layout.shift;
  store(to + place.layout.tail_end, static_cast<std::uint64_t>(tail >> 64));
  store(to + place.layout.tail, static_cast<std::uint64_t>(tail));
  return finish(to, place, raw.length());
}
}
#endif
