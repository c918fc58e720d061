// SPDX-License-Identifier: BSD-3-Clause
#include "granular/sorting/text_dictionary.h"

#include <limits>

namespace granular
{
std::int32_t TextDictionary::index(std::string_view word, const Where& where)
{
  const auto found = indices_.find(word);
  if (found != indices_.end())
  {
    return found->second;
  }
  if (words_.size() == std::numeric_limits<std::int32_t>::max())
  {
    throw LimitError("expected at most 2147483647 different words in a column", where);
  }
  const auto index = static_cast<std::int32_t>(words_.size());
  words_.emplace_back(word);
  indices_.emplace(word, index);
  return index;
}

void TextDictionary::index(
  std::span<const std::string_view> texts, std::int32_t* indices, const Where& where)
{
  for (const std::string_view text : texts)
  {
    *indices++ = this->index(text, where);
  }
}
}
