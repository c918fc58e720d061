// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_text_column_h
#define granular_dump_text_column_h

#include "granular/base/error.h"
#include "granular/dump/dump_reader.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace granular
{
/// Lets words be looked up without a copy.
struct WordHash
{
  using is_transparent = void;

  std::size_t operator()(std::string_view word) const noexcept
  {
    return std::hash<std::string_view>{}(word);
  }
};

/// A column of texts: they become indices of the words that occur. There are few words, and rows may
/// be many.
struct TextColumn
{
  std::size_t array;   ///< index of its array in the frame
  const char* scratch; ///< std::string_views of a batch
  std::unordered_map<std::string, std::int32_t, WordHash, std::equal_to<>> indices; ///< of words

  /// Turns the texts of a batch into indices from row on, and adds new words.
  void index(DumpArray& to, std::int64_t row, std::size_t count, const Where& where);
};
}
#endif
