// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/row_text.h"

#include "granular/base/number.h"
#include "granular/base/row_text_detail.h"
#include "granular/base/words.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>

namespace granular
{
namespace row_text
{
RowStatus store_integer(std::int64_t value, ColumnSink::Kind kind, char* data) noexcept
{
  if (kind == ColumnSink::Kind::Int64)
  {
    std::memcpy(data, &value, sizeof value);
    return RowStatus::Done;
  }
  const auto narrow = static_cast<std::int32_t>(value);
  std::memcpy(data, &narrow, sizeof narrow);
  return narrow == value ? RowStatus::Done : RowStatus::NotExact;
}

RowStatus store_integer(
  const char* first, const char* last, ColumnSink::Kind kind, char* data) noexcept
{
  std::int64_t whole = 0;
  double number = 0;
  if (parse_int64(first, last, whole))
  {
    return store_integer(whole, kind, data);
  }
  return parse_double(first, last, number) ? RowStatus::NotExact : RowStatus::NotANumber;
}

RowStatus store_text(const char* first, const char* last, char* data) noexcept
{
  const std::string_view text(first, static_cast<std::size_t>(last - first));
  std::memcpy(data, &text, sizeof text);
  return RowStatus::Done;
}

RowStatus store_double(const char* first, const char* last, char* data) noexcept
{
  double value = 0;
  if (!parse_double(first, last, value))
  {
    return RowStatus::NotANumber;
  }
  std::memcpy(data, &value, sizeof value);
  return RowStatus::Done;
}

namespace
{
RowStatus store(const char* first, const char* last, const ColumnSink& sink) noexcept
{
  switch (sink.kind)
  {
    case ColumnSink::Kind::Float64:
      return store_double(first, last, sink.data);
    case ColumnSink::Kind::Text:
      return store_text(first, last, sink.data);
    default:
      return store_integer(first, last, sink.kind, sink.data);
  }
}

/// Parses a number without knowing where its word ends. Returns the end; null, with nothing stored,
/// for all words that are not plain numbers of the sink's kind.
const char* store_direct(const char* word, const char* line_end, const ColumnSink& sink) noexcept
{
  const char* const digit = word + (*word == '-' ? 1 : 0);
  if (digit == line_end || *digit < '0' || *digit > '9' || sink.kind == ColumnSink::Kind::Text)
  {
    return nullptr; // nan, inf, '+' and the like too
  }
  const bool real = sink.kind == ColumnSink::Kind::Float64;
  double number = 0;
  std::int64_t whole = 0;
  const auto [end, ec] =
    real ? std::from_chars(word, line_end, number) : std::from_chars(word, line_end, whole);
  if (ec != std::errc{} || (end != line_end && !is_blank(*end)))
  {
    return nullptr;
  }
  if (real)
  {
    std::memcpy(sink.data, &number, sizeof number);
    return end;
  }
  return store_integer(whole, sink.kind, sink.data) == RowStatus::Done ? end : nullptr;
}

/// Counts the words of [at, line_end), storing those that are wanted. count and word are of the
/// word where it stopped.
RowStatus store_row(const char* at, const char* line_end, RowPlan& plan, std::uint32_t& count,
  const char*& word) noexcept
{
  auto sink = plan.sinks.begin();
  for (count = 0;; ++count)
  {
    at = std::find_if_not(at, line_end, is_blank);
    if (at == line_end)
    {
      return count == 0 || count >= plan.columns ? RowStatus::Done : RowStatus::TooFew;
    }
    word = at;
    const bool wanted = sink != plan.sinks.end() && sink->column == count;
    if (const char* const end = wanted ? store_direct(word, line_end, *sink) : nullptr)
    {
      at = end;
      ++sink;
      continue;
    }
    at = std::find_if(at, line_end, is_blank);
    if (wanted)
    {
      const RowStatus status = store(word, at, *sink);
      if (status != RowStatus::Done)
      {
        return status;
      }
      ++sink;
    }
  }
}

/// Decodes the line at result.ptr, which may be blank, the plain way.
void decode_plain_row(const char* last, RowPlan& plan, RowResult& result) noexcept
{
  const void* const feed =
    std::memchr(result.ptr, '\n', static_cast<std::size_t>(last - result.ptr));
  const char* const line_end = static_cast<const char*>(feed);
  std::uint32_t count = 0;
  const char* word = result.ptr;
  result.status = store_row(result.ptr, line_end, plan, count, word);
  if (result.status == RowStatus::Done)
  {
    result.ptr = line_end + 1;
    if (count != 0)
    {
      ++result.rows;
      result.surplus = result.surplus || count > plan.columns;
      for (ColumnSink& sink : plan.sinks)
      {
        sink.data += sink.stride;
      }
    }
  }
  else if (result.status != RowStatus::TooFew)
  {
    result.ptr = word;
    result.column = static_cast<int>(count);
  }
}
}

void decode_plain(
  const char* last, RowPlan& plan, std::int64_t max_rows, RowResult& result) noexcept
{
  while (result.ptr < last && result.rows < max_rows && result.status == RowStatus::Done)
  {
    decode_plain_row(last, plan, result);
  }
}
}

RowResult decode_rows(const char* first, const char* last, std::uint32_t columns,
  std::span<ColumnSink> sinks, std::int64_t max_rows, Simd simd) noexcept
{
  row_text::RowPlan plan{ sinks, columns };
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
  RowResult result{ first };
  row_text::decode_plain(last, plan, max_rows, result);
  return result;
}
}
