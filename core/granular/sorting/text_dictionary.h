// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_sorting_text_dictionary_h
#define granular_sorting_text_dictionary_h

#include "granular/common/error.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
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
  /// Stores the index of each text, and adds new ones. Throws LimitError at `where`.
  void index(std::span<const std::string_view> texts, std::int32_t* indices, const Where& where);

  /// Returns the index of a word, which is added if it is new.
  std::int32_t index(std::string_view word, const Where& where);

  const std::vector<std::string>& words() const noexcept { return words_; }
  std::vector<std::string> take() { return std::move(words_); }

private:
  std::vector<std::string> words_;
  std::unordered_map<std::string, std::int32_t, WordHash, std::equal_to<>> indices_;
};
}
#endif
