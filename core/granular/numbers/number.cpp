// SPDX-License-Identifier: BSD-3-Clause
#include "granular/numbers/number.h"

#include "granular/numbers/number_scan.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
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

ParseResult parse_microsoft(
  const char* first, const char* last, bool negative, double& value) noexcept
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

__extension__ using Wide = unsigned __int128;

/// The double nearest to digits * 10^power, whatever the number of digits.
double nearest(Wide digits, int power) noexcept
{
  double value = 0;
  if (digits >> 64 == 0 && to_double(static_cast<std::uint64_t>(digits), power, value))
  {
    return value;
  }
  std::array<char, 64> text;
  char* const exponent = text.data() + 40; // 2^128 has 39 digits
  char* first = exponent;
  for (; digits != 0; digits /= 10)
  {
    *--first = static_cast<char>('0' + static_cast<int>(digits % 10));
  }
  *exponent = 'e';
  const char* const end = std::to_chars(exponent + 1, text.data() + text.size(), power).ptr;
  parse_double(first, end, value);
  return value;
}
}

ParseResult parse_double(const char* first, const char* last, double& value) noexcept
{
  if (double plain = 0; scan_number(first, last, plain) == last && first != last)
  {
    value = plain;
    return { last, {} };
  }
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
  std::int64_t whole = 0;
  if (scan_number(first, last, whole) == last && first != last)
  {
    value = whole;
    return { last, {} };
  }
  const char* const start = first != last && *first == '+' ? first + 1 : first;
  const auto [ptr, ec] = std::from_chars(start, last, whole);
  if (ec == std::errc{} && ptr == last && (start == first || *start != '-'))
  {
    value = whole;
    return { last, {} };
  }
  double number = 0;
  const ParseResult result = parse_double(first, last, number);
  constexpr double exact =
    9007199254740992.0; // 2^53: above it a double stands for several integers
  if (!result || !(std::abs(number) <= exact) || number != std::trunc(number))
  {
    return invalid(first);
  }
  value = static_cast<std::int64_t>(number);
  return { last, {} };
}

StepClock::StepClock(double step_size) noexcept
  : digits_(0)
{
  std::array<char, 32> text; // d.ddde-ddd
  const char* const end =
    std::to_chars(text.data(), text.data() + text.size(), step_size, std::chars_format::scientific)
      .ptr;
  const char* const exponent = std::find<const char*>(text.data(), end, 'e');
  power_ = 0;
  std::from_chars(exponent + (exponent[1] == '+' ? 2 : 1), end, power_);
  for (const char* digit = text.data(); digit != exponent; ++digit)
  {
    if (*digit != '.')
    {
      digits_ = 10 * digits_ + static_cast<std::uint64_t>(*digit - '0');
    }
  }
  power_ -= std::max(static_cast<int>(exponent - text.data()) - 2, 0);
}

double StepClock::time(std::int64_t step) const noexcept
{
  const auto bits = static_cast<std::uint64_t>(step);
  const double magnitude = nearest(Wide{ step < 0 ? 0 - bits : bits } * digits_, power_);
  return step < 0 ? -magnitude : magnitude;
}
}
