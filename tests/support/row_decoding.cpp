// SPDX-License-Identifier: BSD-3-Clause
#include "row_decoding.h"

#include <algorithm>
#include <cstring>
#include <sstream>

using granular::ColumnSink;
using granular::PaddedBuffer;
using granular::RowStatus;
using granular::Simd;
using granular::ValueType;

namespace
{
/// No value has more bytes than this.
constexpr std::size_t slot = sizeof(std::string_view);
static_assert(slot == 16);

std::size_t width(ValueType type)
{
  return type == ValueType::Text ? slot : type == ValueType::Int32 ? 4 : 8;
}
}

std::string to_string(const Decoded& decoded)
{
  constexpr const char* names[] = { "Done", "TooFew", "NotANumber", "NotExact", "NotDouble",
    "TooMany", "Surplus" };
  std::ostringstream text;
  text << names[static_cast<std::size_t>(decoded.status)] << ", rows " << decoded.rows
       << ", column " << decoded.column << ", stopped at " << decoded.stopped_at;
  return text.str();
}

Decoded decode(std::string_view text, std::uint32_t columns, const std::vector<Wanted>& wanted,
  std::int64_t max_rows, Simd simd)
{
  PaddedBuffer buffer(text.size());
  text.copy(buffer.data(), text.size());
  // digits next to the text would join its first and last words
  std::memset(buffer.data() - PaddedBuffer::padding, '7', PaddedBuffer::padding);
  std::memset(buffer.data() + text.size(), '7', PaddedBuffer::padding);

  const auto lines = static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  std::vector<std::vector<char>> memory;
  std::vector<ColumnSink> sinks;
  for (const Wanted& one : wanted)
  {
    memory.emplace_back(lines * slot, '\x5a');
    sinks.push_back({ one.column, one.type, memory.back().data(), slot });
  }
  granular::RowMemory room;
  const granular::RowResult result = granular::decode_rows(
    buffer.data(), buffer.data() + text.size(), columns, sinks, max_rows, room, simd);

  Decoded decoded{ result.status, result.rows, result.column, result.ptr - buffer.data(), {}, {} };
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    std::vector<std::uint64_t> bits;
    std::vector<std::string> texts;
    const char* from = memory[i].data();
    for (std::int64_t row = 0; row < result.rows; ++row, from += slot)
    {
      std::string_view word;
      std::uint64_t value = 0;
      if (wanted[i].type == ValueType::Text)
      {
        std::memcpy(&word, from, sizeof word);
        texts.emplace_back(word);
      }
      else
      {
        std::memcpy(&value, from, width(wanted[i].type));
        bits.push_back(value);
      }
    }
    if (result.status == RowStatus::Done && sinks[i].data != from)
    {
      bits.push_back(0xbad); // the sink was not moved on past the rows
    }
    decoded.bits.push_back(std::move(bits));
    decoded.texts.push_back(std::move(texts));
  }
  return decoded;
}
