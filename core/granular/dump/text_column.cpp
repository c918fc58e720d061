// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/text_column.h"

#include <limits>

namespace granular
{
void TextColumn::index(DumpArray& to, std::int64_t row, std::size_t count, const Where& where)
{
  auto* const into = static_cast<std::int32_t*>(to.block.data()) + row;
  const auto* const texts = reinterpret_cast<const std::string_view*>(scratch);
  for (std::size_t i = 0; i < count; ++i)
  {
    auto found = indices.find(texts[i]);
    if (found == indices.end())
    {
      if (to.words.size() == std::numeric_limits<std::int32_t>::max())
      {
        throw LimitError("expected at most 2147483647 different words in a column", where);
      }
      found = indices.emplace(texts[i], static_cast<std::int32_t>(to.words.size())).first;
      to.words.emplace_back(texts[i]);
    }
    into[i] = found->second;
  }
}
}
