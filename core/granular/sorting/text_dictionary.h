// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_sorting_text_dictionary_h
#define granular_sorting_text_dictionary_h

#include "granular/common/error.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace granular
{
/// A hash for looking up words without copying them.
struct WordHash
{
  using is_transparent = void;

  std::size_t operator()(std::string_view word) const noexcept
  {
    return std::hash<std::string_view>{}(word);
  }
};

/// The distinct words of a text column, in order of appearance. Words are few, while rows may be many.
class TextDictionary
{
public:
  /// Returns the index of a word, which is added if it is new. Throws LimitError at `where`.
  std::int32_t index(std::string_view word, const Where& where)
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

  std::vector<std::string> take() { return std::move(words_); }

private:
  std::vector<std::string> words_;
  std::unordered_map<std::string, std::int32_t, WordHash, std::equal_to<>> indices_;
};
}
#endif
