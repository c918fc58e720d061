// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_common_words_h
#define granular_common_words_h

#include <algorithm>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Blanks, tabs, CR and all other bytes up to ' ' separate words.
constexpr bool is_blank(char c) noexcept
{
  return static_cast<unsigned char>(c) <= ' ';
}

/// The mark at the beginning of some UTF-8 texts.
inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// Takes the first word off a line, with the blanks before it. Returns an empty word if the line has none.
inline std::string_view take_word(std::string_view& line) noexcept
{
  const auto first = std::find_if_not(line.begin(), line.end(), is_blank);
  const auto end = std::find_if(first, line.end(), is_blank);
  line = { end, line.end() };
  return { first, end };
}

inline bool has_words(std::string_view line) noexcept
{
  return !take_word(line).empty();
}

/// Appends the words of a line.
inline void append_words(std::string_view line, std::vector<std::string_view>& words)
{
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line))
  {
    words.push_back(word);
  }
}

/// Returns the words of a line.
inline std::vector<std::string_view> split_words(std::string_view line)
{
  std::vector<std::string_view> words;
  append_words(line, words);
  return words;
}

/// Returns words with something between them: the elements of a list, or what word_of makes of them.
template <class List, class WordOf = std::identity>
std::string join_words(const List& list, std::string_view between = " ", const WordOf& word_of = {})
{
  std::string text;
  for (const auto& element : list)
  {
    text.append(text.empty() ? std::string_view() : between).append(std::invoke(word_of, element));
  }
  return text;
}

/// Returns a name that is not taken: `name`, or else name_2, name_3 and so on.
template <class IsTaken>
std::string free_name(const std::string& name, const IsTaken& is_taken)
{
  std::string free = name;
  for (int number = 2; is_taken(free); ++number)
  {
    free = name + "_" + std::to_string(number);
  }
  return free;
}

/// Returns a text in quotes, shortened for a message; unprintable bytes become '?'.
inline std::string quoted(std::string_view text)
{
  constexpr std::size_t longest = 40;
  std::string shown(text.substr(0, longest));
  std::replace_if(
    shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + shown + (text.size() > longest ? "...'" : "'");
}
}
#endif
