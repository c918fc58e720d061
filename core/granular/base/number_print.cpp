// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/number_print.h"

#include "granular/base/error.h"

#include <charconv>
#include <string>

namespace granular
{
namespace
{
char* print_exactly(char* to, double value, int digits) noexcept
{
  char* const last = to + most_number_chars;
  return digits == 0 ? std::to_chars(to, last, value).ptr
                     : std::to_chars(to, last, value, std::chars_format::general, digits).ptr;
}
}

NumberFormat parse_number_format(std::string_view text)
{
  if (text == "%g")
  {
    return { 6 };
  }
  if (text == "shortest")
  {
    return { 0 };
  }
  if (text.size() >= 4 && text.starts_with("%.") && text.ends_with('g'))
  {
    const std::string_view number = text.substr(2, text.size() - 3);
    int digits = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), digits);
    if (error == std::errc{} && end == number.data() + number.size() && number[0] != '0' &&
      digits >= 1 && digits <= 17)
    {
      return { digits };
    }
  }
  throw FormatError(
    "expected %g, %.Ng with N from 1 to 17, or shortest, got '" + std::string(text) + "'");
}

char* print_number(char* to, double value, NumberFormat format) noexcept
{
  return print_exactly(to, value, format.digits);
}

char* print_integer(char* to, std::int64_t value) noexcept
{
  return std::to_chars(to, to + most_number_chars, value).ptr;
}
}
