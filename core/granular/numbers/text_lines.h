// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_numbers_text_lines_h
#define granular_numbers_text_lines_h

#include "granular/numbers/number_print.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace granular
{
inline void add_integer(std::string& text, std::int64_t value)
{
  std::array<char, most_number_chars> digits;
  text.append(digits.data(), print_integer(digits.data(), value));
}

/// Appends a line of words and integers.
template <class... Words>
void add_line(std::string& text, const Words&... words)
{
  const auto add = [&](const auto& word)
  {
    if constexpr (std::is_convertible_v<decltype(word), std::string_view>)
    {
      text += word;
    }
    else
    {
      add_integer(text, static_cast<std::int64_t>(word));
    }
  };
  (add(words), ...);
  text += '\n';
}
}
#endif
