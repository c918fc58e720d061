// SPDX-License-Identifier: BSD-3-Clause
// Spellings of formats of numbers.
#include "granular/numbers/number_print.h"

#include "granular/common/error.h"

#include <charconv>
#include <string>
#include <system_error>

namespace granular
{
NumberFormat parse_number_format(std::string_view text)
{
  if (text == "Automatic")
  {
    return automatic_numbers;
  }
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
    "expected a number format of Automatic, %g, %.Ng with N from 1 to 17, or shortest, got '" +
    std::string(text) + "'");
}

std::string to_text(NumberFormat format)
{
  return format == automatic_numbers ? "Automatic"
    : format.digits == 0             ? "shortest"
    : format.digits == 6             ? "%g"
                                     : "%." + std::to_string(format.digits) + "g";
}
}
