// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/number.h"

#include "granular/base/decimal.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

namespace granular
{
namespace
{
constexpr ParseResult invalid(const char* ptr) noexcept
{
  return { ptr, std::errc::invalid_argument };
}

constexpr bool is_digit(char c) noexcept
{
  return c >= '0' && c <= '9';
}

/// Words that old Microsoft run-time libraries print after the sign.
struct Spelling
{
  std::string_view word;
  double value;
};

constexpr Spelling microsoft_spellings[] = {
  { "1.#QNAN", std::numeric_limits<double>::quiet_NaN() },
  { "1.#SNAN", std::numeric_limits<double>::quiet_NaN() },
  { "1.#IND", std::numeric_limits<double>::quiet_NaN() },
  { "1.#INF", std::numeric_limits<double>::infinity() },
};

ParseResult parse_microsoft(const char* first, const char* last, bool negative, double& value) noexcept
{
  const std::string_view word(first, static_cast<std::size_t>(last - first));
  for (const Spelling& spelling : microsoft_spellings)
  {
    if (word.starts_with(spelling.word) &&
      std::all_of(first + spelling.word.size(), last, is_digit))
    {
      value = negative ? -spelling.value : spelling.value;
      return { last, {} };
    }
  }
  return invalid(first);
}

/// Value of a well-formed number that no finite double but zero is near to. from_chars says
/// only "out of range": the decimal exponent of the first digit tells on which side.
double out_of_range(const char* first, const char* last) noexcept
{
  constexpr std::int64_t limit = std::int64_t{ 1 } << 62; // leaves room to add any token's length
  const char* const exponent =
    std::find_if(first, last, [](char c) { return c == 'e' || c == 'E'; });
  std::int64_t power = 0;
  if (exponent != last)
  {
    const char* const digits = exponent + 1 + (exponent[1] == '+' ? 1 : 0);
    if (std::from_chars(digits, last, power).ec == std::errc::result_out_of_range)
    {
      return *digits == '-' ? 0.0 : std::numeric_limits<double>::infinity();
    }
  }
  const char* const point = std::find(first, exponent, '.');
  const char* const leading =
    std::find_if(first, exponent, [](char c) { return c >= '1' && c <= '9'; });
  power = std::clamp(power, -limit, limit);
  // place of the leading digit: positive before the point, zero or negative behind it
  const std::int64_t place = leading < point ? point - leading : point - leading + 1;
  return place + power > 0 ? std::numeric_limits<double>::infinity() : 0.0;
}

/// Digits of a number as they are read.
struct Decimal
{
  std::uint64_t digits = 0;
  std::int64_t power = 0;
};

/// Eight bytes as an integer whose lowest byte is the first of them.
std::uint64_t load_eight(const char* first) noexcept
{
  std::uint64_t bytes;
  std::memcpy(&bytes, first, sizeof bytes);
  return std::endian::native == std::endian::little ? bytes : __builtin_bswap64(bytes);
}

bool all_digits(std::uint64_t bytes) noexcept
{
  const std::uint64_t above = bytes + 0x4646464646464646; // sets the high bit of bytes above '9'
  const std::uint64_t below = bytes - 0x3030303030303030; // and of those below '0'
  return ((above | below) & 0x8080808080808080) == 0;
}

/// Eight digits, the first of them in the lowest byte, by pairs, fours and eights.
std::uint64_t combine_eight(std::uint64_t bytes) noexcept
{
  bytes -= 0x3030303030303030;
  bytes = (bytes * 10 + (bytes >> 8)) & 0x00ff00ff00ff00ff;
  bytes = (bytes * 100 + (bytes >> 16)) & 0x0000ffff0000ffff;
  return (bytes * 10000 + (bytes >> 32)) & 0x00000000ffffffff;
}

const char* read_digits(const char* at, const char* last, std::uint64_t& digits) noexcept
{
  while (last - at >= 8 && all_digits(load_eight(at)))
  {
    digits = digits * 100'000'000 + combine_eight(load_eight(at));
    at += 8;
  }
  for (; at != last && is_digit(*at); ++at)
  {
    digits = digits * 10 + static_cast<std::uint64_t>(*at - '0');
  }
  return at;
}

/// Reads a number without its sign, of up to 19 digits. False for all that is longer or not plain.
bool read_decimal(const char* first, const char* last, Decimal& decimal) noexcept
{
  constexpr std::ptrdiff_t most_digits = 19;  // below 2^64
  constexpr std::ptrdiff_t most_exponent = 5; // far more than a double has
  const char* at = read_digits(first, last, decimal.digits);
  std::ptrdiff_t count = at - first;
  if (at != last && *at == '.')
  {
    const char* const behind = at + 1;
    at = read_digits(behind, last, decimal.digits);
    decimal.power = behind - at;
    count += at - behind;
  }
  if (count == 0 || count > most_digits)
  {
    return false;
  }
  if (at != last && (*at | 0x20) == 'e')
  {
    ++at;
    const bool negative = at != last && *at == '-';
    at += at != last && (*at == '-' || *at == '+') ? 1 : 0;
    std::uint64_t exponent = 0;
    const char* const start = at;
    at = read_digits(at, last, exponent);
    if (at == start || at - start > most_exponent)
    {
      return false;
    }
    decimal.power += negative ? -static_cast<std::int64_t>(exponent) : static_cast<std::int64_t>(exponent);
  }
  return at == last;
}

/// The numbers that are neither long, nor at the ends of the range, nor words.
bool parse_plain(const char* first, const char* last, double& value) noexcept
{
  constexpr std::int64_t exact_power = 22; // of ten
  constexpr double powers[] = { 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12,
    1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22 };
  Decimal decimal;
  if (!read_decimal(first, last, decimal))
  {
    return false;
  }
  if (decimal.digits == 0)
  {
    value = 0;
    return true;
  }
  if (decimal.digits >> 53 == 0 && decimal.power >= -exact_power && decimal.power <= exact_power)
  {
    // both operands are exact: one rounding
    const double digits = static_cast<double>(decimal.digits);
    value = decimal.power < 0 ? digits / powers[-decimal.power] : digits * powers[decimal.power];
    return true;
  }
  return nearest_double(decimal.digits, decimal.power, value);
}
}

ParseResult parse_double(const char* first, const char* last, double& value) noexcept
{
  const char* start = first;
  const bool negative = start != last && *start == '-';
  if (start != last && (*start == '-' || *start == '+'))
  {
    ++start;
  }
  if (start == last || *start == '-' || *start == '+')
  {
    return invalid(start);
  }
  double magnitude = 0;
  if (parse_plain(start, last, magnitude))
  {
    value = negative ? -magnitude : magnitude;
    return { last, {} };
  }
  const auto [ptr, ec] = std::from_chars(start, last, magnitude);
  if (ec == std::errc::invalid_argument)
  {
    return invalid(start);
  }
  if (ptr != last)
  {
    return *ptr == '#' ? parse_microsoft(start, last, negative, value) : invalid(ptr);
  }
  if (ec == std::errc::result_out_of_range)
  {
    magnitude = out_of_range(start, last);
  }
  value = negative ? -magnitude : magnitude;
  return { last, {} };
}

ParseResult parse_int64(const char* first, const char* last, std::int64_t& value) noexcept
{
  const char* const start = first != last && *first == '+' ? first + 1 : first;
  std::int64_t whole = 0;
  const auto [ptr, ec] = std::from_chars(start, last, whole);
  if (ec == std::errc{} && ptr == last && (start == first || *start != '-'))
  {
    value = whole;
    return { last, {} };
  }
  double number = 0;
  const ParseResult result = parse_double(first, last, number);
  constexpr double exact = 9007199254740992.0; // 2^53: above it a double stands for several integers
  if (!result || !(std::abs(number) <= exact) || number != std::trunc(number))
  {
    return invalid(first);
  }
  value = static_cast<std::int64_t>(number);
  return { last, {} };
}
}
