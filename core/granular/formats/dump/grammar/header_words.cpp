// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/text_header.h"

#include "granular/formats/dump/grammar/text_dump.h"
#include "granular/numbers/number.h"
#include "granular/numbers/number_scan.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace granular
{
std::vector<std::string_view> item_words(std::string_view line)
{
  if (line.starts_with(byte_order_mark))
  {
    line.remove_prefix(byte_order_mark.size());
  }
  return take_word(line) == item_mark ? split_words(line) : std::vector<std::string_view>();
}

std::size_t find_glued_header(std::string_view line)
{
  if (line.find(item_mark, 1) == line.npos)
  {
    return 0;
  }
  const std::size_t found = line.rfind(item_mark); // the last: it may have been killed twice
  const std::string_view before = line.substr(0, found);
  return before == byte_order_mark || !has_words(before) ||
      !opens_frame(item_words(line.substr(found)))
    ? 0
    : found;
}

bool is_number(std::string_view word) noexcept
{
  double number = 0;
  return static_cast<bool>(parse_double(word.data(), word.data() + word.size(), number));
}

bool is_misplaced(std::string_view word) noexcept
{
  constexpr std::string_view names[] = { "xy", "xz", "yz", "abc", "origin" };
  return std::ranges::find(names, word) != std::end(names) || is_number(word);
}

int digits_of(std::string_view word) noexcept
{
  word = word.substr(0, word.find_first_of("eE"));
  const std::size_t first = word.find_first_of("123456789");
  return first == word.npos ? 0
                            : static_cast<int>(std::ranges::count_if(word.substr(first), is_digit));
}

double rounding_of(std::string_view word, double value) noexcept
{
  const bool whole = word.find_first_of(".eE") == word.npos;
  const bool is_round = digits_of(word) != fewest_digits || (whole && word.ends_with('0'));
  return is_round || !std::isfinite(value)
    ? 0
    : 0.5 * std::pow(10, std::floor(std::log10(std::abs(value))) + 1 - fewest_digits);
}

bool opens_frame(std::span<const std::string_view> words) noexcept
{
  return words.size() == 1 && (words[0] == "TIMESTEP" || words[0] == "UNITS" || words[0] == "TIME");
}

bool says_nothing(std::string_view line) noexcept
{
  const std::string_view word = take_word(line);
  return word.empty() || word.front() == '#';
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

std::optional<RowsOf> tell_rows(std::string_view first_bytes)
{
  constexpr int longest_header = 64; // lines
  bool opened = false;
  if (first_bytes.starts_with(byte_order_mark))
  {
    first_bytes.remove_prefix(byte_order_mark.size());
  }
  for (int line = 0; line < longest_header && !first_bytes.empty(); ++line)
  {
    const std::size_t feed = first_bytes.find('\n');
    const std::string_view text = first_bytes.substr(0, feed);
    const std::vector<std::string_view> words = item_words(text);
    if (!opened && !says_nothing(text))
    {
      if (!opens_frame(words))
      {
        return {};
      }
      opened = true;
    }
    if (feed != first_bytes.npos && begins_with(words, "NUMBER OF"))
    {
      return begins_with(words, "NUMBER OF ATOMS") ? RowsOf::Particles : RowsOf::Others;
    }
    if (feed != first_bytes.npos && begins_with(words, "GRID SIZE"))
    {
      return RowsOf::Cells;
    }
    first_bytes.remove_prefix(feed == first_bytes.npos ? first_bytes.size() : feed + 1);
  }
  return opened ? std::optional(RowsOf::Any) : std::nullopt;
}

bool is_text_dump(std::string_view first_bytes)
{
  const std::optional<RowsOf> rows = tell_rows(first_bytes);
  return rows == RowsOf::Particles || rows == RowsOf::Any;
}
}
