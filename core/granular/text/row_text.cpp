// SPDX-License-Identifier: BSD-3-Clause
#include "granular/text/row_text.h"

#include "granular/common/words.h"
#include "granular/numbers/number.h"
#include "granular/numbers/number_scan.h"
#include "granular/text/row_text_detail.h"

#include <cstring>

namespace granular
{
namespace row_text
{
void FreeBatch::operator()(Batch* batch) const noexcept
{
  delete batch;
}

void store_text(const char* first, const char* last, char* data) noexcept
{
  const std::string_view text(first, static_cast<std::size_t>(last - first));
  std::memcpy(data, &text, sizeof text);
}

namespace
{
RowStatus store_integer(std::int64_t value, ValueType type, char* data) noexcept
{
  if (type == ValueType::Int64)
  {
    std::memcpy(data, &value, sizeof value);
    return RowStatus::Done;
  }
  const auto narrow = static_cast<std::int32_t>(value);
  std::memcpy(data, &narrow, sizeof narrow);
  return narrow == value ? RowStatus::Done : RowStatus::NotExact;
}

/// A word of any kind.
RowStatus store(const char* first, const char* last, const ColumnSink& sink) noexcept
{
  if (sink.type == ValueType::Text)
  {
    store_text(first, last, sink.data);
    return RowStatus::Done;
  }
  double number = 0;
  std::int64_t whole = 0;
  if (sink.type != ValueType::Float64 && parse_int64(first, last, whole))
  {
    return store_integer(whole, sink.type, sink.data);
  }
  if (!parse_double(first, last, number))
  {
    return RowStatus::NotANumber;
  }
  if (sink.type != ValueType::Float64)
  {
    return RowStatus::NotExact;
  }
  std::memcpy(sink.data, &number, sizeof number);
  return RowStatus::Done;
}

/// The number of a word that ends nobody knows where; its end, null if it is not a plain one.
template <typename Value>
const char* scan_word(const char* word, const char* last, Value& value) noexcept
{
  const char* const end = scan_number(word, last, value);
  return end && is_blank(*end) ? end : nullptr;
}

/// Stores a plain number of the sink's kind. Returns the end of the word; null, with nothing stored
/// that counts, for all other words.
const char* store_plain(const char* word, const char* last, const ColumnSink& sink) noexcept
{
  if (sink.type == ValueType::Float64)
  {
    double number = 0;
    const char* const end = scan_word(word, last, number);
    std::memcpy(sink.data, &number, sizeof number);
    return end;
  }
  if (sink.type == ValueType::Text)
  {
    return nullptr;
  }
  std::int64_t whole = 0;
  const char* const end = scan_word(word, last, whole);
  return store_integer(whole, sink.type, sink.data) == RowStatus::Done ? end : nullptr;
}

const char* skip_blanks(const char* at) noexcept
{
  while (is_blank(*at) && *at != '\n')
  {
    ++at;
  }
  return at;
}

const char* skip_word(const char* at) noexcept
{
  while (!is_blank(*at))
  {
    ++at;
  }
  return at;
}

/// Place where decoding a row stopped.
struct RowEnd
{
  RowStatus status;
  std::uint32_t count; ///< words before
  const char* word;    ///< that is not what it should be; Done: the line feed
};

/// Counts the words of the line at first, storing those that are wanted, up to a word that is not
/// what it should be. last: of the text.
RowEnd store_row(const char* first, const char* last, const RowPlan& plan) noexcept
{
  const ColumnSink* sink = plan.sinks.data();
  const ColumnSink* const sinks_end = sink + plan.sinks.size();
  const char* at = first;
  for (std::uint32_t count = 0;; ++count)
  {
    at = skip_blanks(at);
    if (count == plan.columns && (plan.loose || *at == '#'))
    {
      at = std::find(at, last, '\n');
    }
    if (*at == '\n')
    {
      const RowStatus status = count == 0 || count == plan.columns ? RowStatus::Done
        : count < plan.columns                                     ? RowStatus::TooFew
                                                                   : RowStatus::Surplus;
      return { status, count, at };
    }
    if (sink == sinks_end || sink->column != count)
    {
      at = skip_word(at);
      continue;
    }
    const char* end = store_plain(at, last, *sink);
    if (!end)
    {
      end = skip_word(at);
      const RowStatus status = store(at, end, *sink);
      if (status != RowStatus::Done)
      {
        return { status, count, at };
      }
    }
    at = end;
    ++sink;
  }
}
}

void decode_plain(
  const char* last, RowPlan& plan, std::int64_t max_rows, RowResult& result) noexcept
{
  while (result.ptr < last && result.rows < max_rows && result.status == RowStatus::Done)
  {
    const RowEnd row = store_row(result.ptr, last, plan);
    result.status = row.status;
    if (row.status == RowStatus::Done)
    {
      result.ptr = row.word + 1;
      result.rows += row.count != 0 ? 1 : 0;
      for (ColumnSink& sink : plan.sinks)
      {
        sink.data += row.count != 0 ? sink.stride : 0;
      }
    }
    else if (row.status != RowStatus::TooFew && row.status != RowStatus::Surplus)
    {
      result.ptr = row.word;
      result.column = static_cast<int>(row.count);
    }
  }
}
}

RowStatus check_word(std::string_view word, ValueType type) noexcept
{
  char value[sizeof(std::string_view)];
  return row_text::store(word.data(), word.data() + word.size(), { 0, type, value, 0 });
}

RowResult decode_rows(const char* first, const char* last, RowWords words,
  std::span<ColumnSink> sinks, std::int64_t max_rows, RowMemory& memory, Simd simd) noexcept
{
  row_text::RowPlan plan{ sinks, words.columns, words.loose, memory };
#if GRANULAR_X86
  switch (simd)
  {
    case Simd::Avx512:
      return row_text::avx512::decode(first, last, plan, max_rows);
    case Simd::Avx2:
      return row_text::avx2::decode(first, last, plan, max_rows);
    case Simd::Portable:
      break;
  }
#endif
  static_cast<void>(simd);
  RowResult result{ first };
  row_text::decode_plain(last, plan, max_rows, result);
  return result;
}
}
