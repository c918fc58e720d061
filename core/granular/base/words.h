// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_base_words_h
#define granular_base_words_h

#include <algorithm>
#include <string_view>
#include <vector>

namespace granular
{
/// Blanks, tabs, CR and all other bytes up to ' ' separate words.
constexpr bool is_blank(char c) noexcept
{
  return static_cast<unsigned char>(c) <= ' ';
}

/// The words of a line.
inline std::vector<std::string_view> split_words(std::string_view line)
{
  std::vector<std::string_view> words;
  auto at = std::find_if_not(line.begin(), line.end(), is_blank);
  while (at != line.end())
  {
    const auto end = std::find_if(at, line.end(), is_blank);
    words.emplace_back(at, end);
    at = std::find_if_not(end, line.end(), is_blank);
  }
  return words;
}
}
#endif
