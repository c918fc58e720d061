// SPDX-License-Identifier: BSD-3-Clause
#include "granular/common/error.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace granular
{
namespace
{
/// The bytes of the character that a text begins with; 0: it is a control character, or not UTF-8.
std::size_t printable_length(std::string_view text) noexcept
{
  const auto byte = [&](std::size_t i)
  { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80)
  {
    return first < ' ' || first == 0x7f ? 0 : 1;
  }
  // what the second byte may be rules out control characters, surrogates, and longer forms than needed
  static constexpr struct
  {
    unsigned first, last, low, high, length;
  } forms[] = { { 0xc2, 0xc2, 0xa0, 0xbf, 2 }, { 0xc3, 0xdf, 0x80, 0xbf, 2 },
    { 0xe0, 0xe0, 0xa0, 0xbf, 3 }, { 0xe1, 0xec, 0x80, 0xbf, 3 }, { 0xed, 0xed, 0x80, 0x9f, 3 },
    { 0xee, 0xef, 0x80, 0xbf, 3 }, { 0xf0, 0xf0, 0x90, 0xbf, 4 }, { 0xf1, 0xf3, 0x80, 0xbf, 4 },
    { 0xf4, 0xf4, 0x80, 0x8f, 4 } };
  const auto continues = [](unsigned value) { return value >= 0x80 && value <= 0xbf; };
  for (const auto& form : forms)
  {
    if (form.first <= first && first <= form.last && form.low <= byte(1) && byte(1) <= form.high &&
      (form.length < 3 || continues(byte(2))) && (form.length < 4 || continues(byte(3))))
    {
      return form.length;
    }
  }
  return 0;
}

std::string message(const std::string& text, const Where& where)
{
  const std::string place = to_string(where);
  return place.empty() ? shown_path(text) : place + ": " + shown_path(text);
}
}

std::string shown_path(std::string_view path)
{
  std::string shown;
  while (!path.empty())
  {
    const std::size_t length = printable_length(path);
    if (length == 0)
    {
      constexpr std::string_view digits = "0123456789abcdef";
      const auto byte = static_cast<unsigned char>(path[0]);
      shown += byte == '\n' ? "\\n"
        : byte == '\t'      ? "\\t"
                            : std::string("\\x") + digits[byte >> 4] + digits[byte & 15];
    }
    shown += path.substr(0, length);
    path.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return shown;
}

std::string to_string(const Where& where)
{
  std::string text = shown_path(where.path);
  if (where.line > 0)
  {
    text += ":" + std::to_string(where.line);
  }
  else if (where.byte >= 0)
  {
    text += "@" + std::to_string(where.byte);
  }
  if (!where.column.empty())
  {
    text += text.empty() ? "" : ": ";
    text += "column '" + shown_path(where.column) + "'";
  }
  return text;
}

Error::Error(const std::string& text, Where where)
  : std::runtime_error(message(text, where))
  , text_(shown_path(text))
  , where_(std::move(where))
{
}

IoError::IoError(const std::string& text, Where where, std::errc code)
  : Error(text, std::move(where))
  , code_(code)
{
}

std::string to_string(const Notice& notice)
{
  return message(notice.text, notice.where);
}

std::string subject_of(const Notice& notice, bool of_files)
{
  const std::string about = of_files ? std::to_string(notice.where.line) : notice.where.column;
  const std::string what = !notice.topic.empty() ? notice.topic
    : of_files || about.empty()                  ? notice.text
                                                 : "";
  return notice.where.path + "\n" + about + "\n" + what;
}
}
