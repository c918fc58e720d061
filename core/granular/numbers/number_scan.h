// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_number_scan_h
#define granular_numbers_number_scan_h

// Inline parsing of plain numbers at the beginning of a text: the first attempt of parse_double and parse_int64.

#include "granular/numbers/decimal.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace granular
{
constexpr bool is_digit(char c) noexcept
{
  return static_cast<unsigned char>(c - '0') <= 9;
}

/// Returns eight characters as a number, the first in the lowest byte, on machines of any byte order.
inline std::uint64_t load_eight(const char* first) noexcept
{
  std::uint64_t bytes = 0;
  for (int i = 0; i < 8; ++i)
  {
    bytes |= std::uint64_t{ static_cast<unsigned char>(first[i]) } << (8 * i);
  }
  return bytes;
}

/// Returns the value of eight digits, each 0 to 9 in a byte, the first in the lowest byte.
constexpr std::uint64_t combine_eight(std::uint64_t digits) noexcept
{
  const std::uint64_t pairs = (digits * 10 + (digits >> 8)) & 0x00ff00ff00ff00ff;
  const std::uint64_t fours = (pairs * 100 + (pairs >> 16)) & 0x0000ffff0000ffff;
  return (fours * 10000 + (fours >> 32)) & 0xffffffff;
}

/// A number with digits appended, and the end of the digits.
struct Digits
{
  const char* end;
  std::uint64_t number;
};

/// Appends the digits at `first` to number, as far as they go.
inline Digits take_digits(const char* first, const char* last, std::uint64_t number) noexcept
{
  static constexpr std::uint64_t powers[] = { 1, 10, 100, 1000, 10000, 100000, 1000000, 10000000,
    100000000 };
  while (last - first >= 8)
  {
    const std::uint64_t digits = load_eight(first) ^ 0x3030303030303030;
    // a byte above 9 sets its highest bit; a carry affects only bytes behind it
    const std::uint64_t others = ((digits + 0x7676767676767676) | digits) & 0x8080808080808080;
    if (others != 0)
    {
      // no digit after 8 or 16 of them, or a single one: the end is known before the arithmetic is done, and the next
      // word starts early
      if ((others & 0x80) != 0)
      {
        return { first, number };
      }
      if ((others & 0x8000) != 0)
      {
        return { first + 1, number * 10 + (digits & 0xff) };
      }
      const int count = std::countr_zero(others) / 8;
      number = number * powers[count] + combine_eight(digits << (64 - 8 * count));
      return { first + count, number };
    }
    number = number * powers[8] + combine_eight(digits);
    first += 8;
  }
  for (; first != last && is_digit(*first); ++first)
  {
    number = number * 10 + static_cast<std::uint64_t>(*first - '0');
  }
  return { first, number };
}

/// Parses the exponent at `first`: a letter, an optional sign, up to four digits. Returns its end; null if it has
/// another form.
inline const char* take_exponent(const char* first, const char* last, std::int64_t& power) noexcept
{
  ++first;
  const bool negative = first != last && *first == '-';
  first += first != last && (*first == '-' || *first == '+') ? 1 : 0;
  const char* const start = first;
  std::int64_t magnitude = 0;
  for (; first != last && is_digit(*first) && first - start < 5; ++first)
  {
    magnitude = magnitude * 10 + (*first - '0');
  }
  power += negative ? -magnitude : magnitude;
  return first == start || first - start == 5 ? nullptr : first;
}

/// Returns the number of digits in [first, last), from the first non-zero one; points are skipped.
inline std::ptrdiff_t count_significant(const char* first, const char* last) noexcept
{
  const auto is_leading = [](char c) { return c == '0' || c == '.'; };
  return std::count_if(std::find_if_not(first, last, is_leading), last, is_digit);
}

/// The number of digits that always fit into 64 bits.
inline constexpr std::ptrdiff_t most_digits = 19;

/// Parses a plain number at the beginning of a text: an optional minus sign, up to 19 digits and a point, and an
/// optional exponent. Returns its end; null, with value unchanged, for other forms.
inline const char* scan_number(const char* first, const char* last, double& value) noexcept
{
  const bool negative = first != last && *first == '-';
  const char* const start = first + (negative ? 1 : 0);
  Digits digits{ start, 0 };
  if (start != last && is_digit(*start)) // most numbers have one digit before the point
  {
    digits = { start + 1, static_cast<std::uint64_t>(*start - '0') };
  }
  if (digits.end != last && is_digit(*digits.end))
  {
    digits = take_digits(digits.end, last, digits.number);
  }
  std::ptrdiff_t count = digits.end - start;
  std::int64_t power = 0;
  if (digits.end != last && *digits.end == '.')
  {
    const char* const fraction = digits.end + 1;
    digits = take_digits(fraction, last, digits.number);
    power = fraction - digits.end;
    count += digits.end - fraction;
  }
  if (count == 0 || (count > most_digits && count_significant(start, digits.end) > most_digits))
  {
    return nullptr;
  }
  const char* end = digits.end;
  if (end != last && (*end | 0x20) == 'e')
  {
    end = take_exponent(end, last, power);
  }
  double magnitude = 0;
  if (!end || !to_double(digits.number, power, magnitude))
  {
    return nullptr;
  }
  value = std::bit_cast<double>(
    std::bit_cast<std::uint64_t>(magnitude) | std::uint64_t{ negative } << 63);
  return end;
}

/// Parses a plain integer: an optional minus sign, and up to 18 digits.
inline const char* scan_number(const char* first, const char* last, std::int64_t& value) noexcept
{
  const bool negative = first != last && *first == '-';
  const char* const start = first + (negative ? 1 : 0);
  const Digits digits = take_digits(start, last, 0);
  if (digits.end == start || digits.end - start >= most_digits)
  {
    return nullptr;
  }
  const auto sign = std::uint64_t{ negative };
  value = static_cast<std::int64_t>((digits.number ^ (0 - sign)) + sign);
  return digits.end;
}
}
#endif
