// SPDX-License-Identifier: BSD-3-Clause
#include "granular/numbers/printed_digits.h"

#include "granular/numbers/number_scan.h"

#include <algorithm>
#include <cmath>

namespace granular
{
int digits_of(std::string_view word) noexcept
{
  word = word.substr(0, word.find_first_of("eE"));
  const std::size_t first = word.find_first_of("123456789");
  return first == word.npos ? 0
                            : static_cast<int>(std::ranges::count_if(word.substr(first), is_digit));
}

int digits_of_real(std::string_view word) noexcept
{
  return word.find_first_of(".eE") == word.npos ? 0 : digits_of(word);
}

double rounding_of(std::string_view word, double value) noexcept
{
  const bool whole = word.find_first_of(".eE") == word.npos;
  const bool is_round = digits_of(word) != fewest_digits || (whole && word.ends_with('0'));
  return is_round || !std::isfinite(value)
    ? 0
    : 0.5 * std::pow(10, std::floor(std::log10(std::abs(value))) + 1 - fewest_digits);
}
}
