// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/text_header.h"

#include "granular/numbers/number_scan.h"

#include <algorithm>

namespace granular
{
int digits_of(std::string_view word) noexcept
{
  word = word.substr(0, word.find_first_of("eE"));
  const std::size_t first = word.find_first_of("123456789");
  return first == word.npos ? 0
                            : static_cast<int>(std::ranges::count_if(word.substr(first), is_digit));
}

bool opens_frame(std::span<const std::string_view> words) noexcept
{
  return words.size() == 1 && (words[0] == "TIMESTEP" || words[0] == "UNITS" || words[0] == "TIME");
}

bool begins_with(
  std::span<const std::string_view> words, std::string_view name, bool alone) noexcept
{
  std::size_t same = 0;
  for (auto wanted = take_word(name); !wanted.empty(); wanted = take_word(name))
  {
    if (same == words.size() || words[same] != wanted)
    {
      return false;
    }
    ++same;
  }
  return !alone || same == words.size();
}
}
