// SPDX-License-Identifier: BSD-3-Clause
#include "granular/numbers/step_clock.h"

#include "granular/numbers/decimal.h"
#include "granular/numbers/number.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace granular
{
namespace
{
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
