// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/text_rows.h"

#include "granular/numbers/number.h"
#include "granular/text/line_scan.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

namespace granular
{
namespace
{
/// With fewer rows than that for each stretch of chosen ones it is faster to decode them all: beginning a stretch takes as long as
/// two of them.
constexpr std::int64_t rows_a_stretch = 4;

/// The line behind so many lines with words.
const char* skip_rows(const char* at, const char* last, std::size_t rows) noexcept
{
  while (rows > 0)
  {
    const std::size_t length = std::string_view(at, static_cast<std::size_t>(last - at)).find('\n');
    const char* const end = at + length;
    rows -= std::all_of(at, end, is_blank) ? 0U : 1U;
    at = end + 1;
  }
  return at;
}

/// Returns true if rows that were decoded may hold integers of 64 bits that no double holds, in a column where these count.
bool may_be_long(std::span<const ColumnSink> sinks, std::int64_t rows) noexcept
{
  bool found = false;
  for (const ColumnSink& sink : sinks)
  {
    const char* from = sink.data - rows * sink.stride;
    for (std::int64_t row = sink.open ? 0 : rows; row < rows; ++row, from += sink.stride)
    {
      double value = 0;
      std::memcpy(&value, from, sizeof value);
      found |= std::abs(value) >= 0x1p53 && std::abs(value) <= 0x1p63; // without a branch for each
    }
  }
  return found;
}

/// Returns true if a word is an integer of 64 bits that no double holds.
bool is_long(std::string_view word) noexcept
{
  std::int64_t whole = 0;
  const bool is_integer =
    word.find_first_not_of("0123456789", word.front() == '-' ? 1 : 0) == word.npos &&
    parse_int64(word.data(), word.data() + word.size(), whole);
  const auto number = static_cast<double>(whole);
  return is_integer && !(number < 0x1p63 && static_cast<std::int64_t>(number) == whole);
}
}

/// Brings [from, to) of the content behind what is in the buffer.
void TextReader::load(std::int64_t from, std::int64_t to)
{
  const auto bytes = static_cast<std::size_t>(to - from);
  if (buffer_.size() < filled_ + bytes)
  {
    constexpr std::size_t step = std::size_t{ 1 } << 14; // chunks differ a little
    buffer_.resize((filled_ + bytes) / step * step + 2 * step);
  }
  const std::size_t got = of_.source_.read(from, buffer_.data() + filled_, bytes);
  if (got < bytes)
  {
    throw IoError("the file was shortened while it was read: expected " +
        std::to_string(of_.entry_.end) + " bytes, got " +
        std::to_string(from + static_cast<std::int64_t>(got)),
      { of_.source_.path() });
  }
  filled_ += bytes;
}

/// A longer one may be anything: it is not read into memory to find its end.
void TextReader::check_length(std::size_t first, std::size_t end) const
{
  if (end - first > TextScanner::longest_line)
  {
    throw LimitError("expected a row of at most " + std::to_string(TextScanner::longest_line) +
        " bytes, got a longer one",
      of_.where({ RowStatus::TooFew, -1, {}, offset_ + static_cast<std::int64_t>(first) }));
  }
}

/// The end of the line that the byte at `at` is in, which is loaded as far as it is not. One that ends with the frame gets the line feed
/// that it lacks.
std::size_t TextReader::load_line(std::size_t at)
{
  const std::size_t before = std::string_view(buffer_.data(), at).rfind('\n');
  const std::size_t line = before == std::string_view::npos ? first_ : std::max(first_, before + 1);
  std::int64_t more = 4096;
  for (;;)
  {
    const std::size_t feed = std::string_view(buffer_.data(), filled_).find('\n', at);
    this->check_length(line, std::min(feed, filled_));
    if (feed != std::string_view::npos)
    {
      return feed + 1;
    }
    at = filled_;
    const std::int64_t offset = offset_ + static_cast<std::int64_t>(filled_);
    if (offset == of_.entry_.end)
    {
      buffer_.data()[filled_] = '\n'; // at most the first byte of the padding
      filled_ += line < filled_ ? 1 : 0;
      return filled_;
    }
    this->load(offset, std::min(of_.entry_.end, offset + more));
    more *= 2;
  }
}

void TextReader::open(std::int64_t first, std::int64_t last)
{
  constexpr std::int64_t rest = 512; // of the last row: most are shorter
  const std::int64_t from = std::max(of_.rows_offset_, of_.entry_.offset + first);
  const std::int64_t to = std::min(of_.entry_.end, of_.entry_.offset + last);
  first_ = at_ = end_ = filled_ = 0;
  if (from >= to)
  {
    return;
  }
  const bool inside = from > of_.rows_offset_; // then the line feed before tells where rows begin
  offset_ = from - (inside ? 1 : 0);
  this->load(offset_, std::min(of_.entry_.end, to + rest));
  const auto limit = static_cast<std::size_t>(to - offset_); // rows begin before
  const std::string_view text(buffer_.data(), limit);
  if (inside)
  {
    const std::size_t feed = text.substr(0, limit - 1).find('\n');
    if (feed == text.npos)
    {
      return;
    }
    first_ = at_ = feed + 1;
  }
  end_ = this->load_line(limit - 1);
}

std::int64_t TextReader::rows() const noexcept
{
  std::int64_t rows = 0;
  const char* const last = buffer_.data() + end_;
  for (const char* first = buffer_.data() + first_; first < last;)
  {
    // a line may begin with any byte: that one is passed over as one that begins with another
    const LineScan scan = scan_lines(first, last, '\0', { first == buffer_.data() + first_, true });
    rows += scan.feeds - scan.blank_lines;
    first = scan.ptr < last ? scan.ptr + 1 : last;
  }
  return rows;
}

bool TextReader::more() const noexcept
{
  return !std::all_of(buffer_.data() + at_, buffer_.data() + end_, is_blank);
}

std::int64_t TextReader::decode(std::span<ColumnSink> sinks, std::int64_t max_rows)
{
  if (this->columns().columns == 0) // of an empty frame that names none
  {
    return 0;
  }
  const char* const last = buffer_.data() + end_;
  const RowResult result =
    decode_rows(buffer_.data() + at_, last, this->columns(), sinks, max_rows, memory_);
  this->check(buffer_.data() + at_, last, result, sinks);
  at_ = static_cast<std::size_t>(result.ptr - buffer_.data());
  return result.rows;
}

/// Decodes all rows, chosen or not. Returns false, with the sinks as before, if a row is not what it should be: it may be one that
/// nobody wants.
bool TextReader::decode_numbers(
  std::span<ColumnSink> sinks, std::int64_t max_rows, const RowChoice& choice, RowCounts& counts)
{
  constexpr std::int64_t most_looked_at = 256;
  const std::vector<ColumnSink> before(sinks.begin(), sinks.end());
  const auto chosen_by = std::ranges::find(before, choice.column, &ColumnSink::column);
  const RowResult result = decode_rows(
    buffer_.data() + at_, buffer_.data() + end_, this->columns(), sinks, max_rows, memory_);
  if (result.status != RowStatus::Done || chosen_by == before.end() ||
    may_be_long(sinks, result.rows))
  {
    std::ranges::copy(before, sinks.begin());
    return false;
  }
  const std::int64_t looked_at = std::min(result.rows, most_looked_at);
  std::int64_t chosen = 0;
  const char* from = chosen_by->data;
  for (std::int64_t row = 0; row < looked_at; ++row, from += chosen_by->stride)
  {
    std::int64_t number = 0;
    std::memcpy(&number, from, sizeof number);
    chosen += choice.passes(number) ? 1 : 0;
  }
  many_chosen_ = chosen > looked_at / rows_a_stretch;
  at_ = static_cast<std::size_t>(result.ptr - buffer_.data());
  counts = { result.rows, result.rows };
  return true;
}

/// Decodes the column of the choice of all rows, and then whole stretches of rows that pass. A row in which the choice
/// fails comes after those before it.
RowCounts TextReader::decode_chosen(
  std::span<ColumnSink> sinks, std::int64_t max_rows, const RowChoice& choice)
{
  RowCounts counts;
  // texts of rows that nobody wants must not become words of an array
  const bool texts =
    std::ranges::any_of(sinks, [](const ColumnSink& sink) { return sink.type == ValueType::Text; });
  if (many_chosen_ && !texts && this->decode_numbers(sinks, max_rows, choice, counts))
  {
    return counts;
  }
  chosen_by_.resize(static_cast<std::size_t>(max_rows));
  ColumnSink numbers{ choice.column, ValueType::Int64, reinterpret_cast<char*>(chosen_by_.data()),
    sizeof(std::int64_t) };
  const char* at = buffer_.data() + at_;
  const char* const last = buffer_.data() + end_;
  const RowResult all =
    decode_rows(at, last, this->columns(), std::span(&numbers, 1), max_rows, memory_);
  const auto rows = static_cast<std::size_t>(all.rows);
  const auto passes = [&](std::size_t row) { return choice.passes(chosen_by_[row]); };
  counts = { all.rows };
  std::size_t passed = 0; // rows before `at`
  std::int64_t stretches = 0;
  for (std::size_t row = 0; row < rows; ++row)
  {
    if (!passes(row))
    {
      continue;
    }
    const std::size_t first = row;
    while (row + 1 < rows && passes(row + 1))
    {
      ++row;
    }
    at = skip_rows(at, last, first - passed);
    passed = row + 1;
    const char* const behind = skip_rows(at, last, passed - first);
    const RowResult some = decode_rows(at, behind, this->columns(), sinks, max_rows, memory_);
    this->check(at, behind, some, sinks);
    counts.decoded += some.rows;
    at = behind;
    ++stretches;
  }
  many_chosen_ = stretches > all.rows / rows_a_stretch;
  this->check(buffer_.data() + at_, last, all, std::span(&numbers, 1));
  at_ = static_cast<std::size_t>(all.ptr - buffer_.data());
  return counts;
}

RowWords TextReader::columns() const noexcept
{
  const FrameKind& kind = *of_.entry_.kind;
  return { static_cast<std::uint32_t>(kind.schema.columns().size()), kind.loose };
}

/// Throws what is wrong in rows that were decoded from `first` on, or in the lines up to `last` if not all were, if anything is.
/// A column that must change is looked at as what it becomes.
void TextReader::check(const char* first, const char* last, const RowResult& result,
  std::span<const ColumnSink> sinks) const
{
  const auto misfit = [&](RowStatus status, int column, std::string_view word, std::int64_t line)
  {
    return Misfit{ status, column, std::string(word), offset_ + (word.data() - buffer_.data()),
      line };
  };
  if (result.status == RowStatus::TooFew || result.status == RowStatus::Surplus)
  {
    const char* const end = std::find(result.ptr, last, '\n');
    throw Misfits{ misfit(result.status, -1, { result.ptr, end }, 0) };
  }
  if (result.status == RowStatus::Done && !may_be_long(sinks, result.rows))
  {
    return;
  }
  Misfits misfits;
  std::int64_t line = 0; // from the first misfit on
  std::vector<ValueType> types;
  std::ranges::transform(sinks, std::back_inserter(types), &ColumnSink::type);
  const char* const limit = result.status == RowStatus::Done ? result.ptr : last;
  for (const char* from = first; from < limit; line += misfits.empty() ? 0 : 1)
  {
    const char* const end = std::find(from, limit, '\n');
    std::string_view rest(from, end);
    int column = -1; // that of the last word that was taken
    for (std::size_t sink = 0; sink < sinks.size(); ++sink)
    {
      std::string_view word;
      for (; column < static_cast<int>(sinks[sink].column); ++column)
      {
        word = take_word(rest);
      }
      if (word.empty())
      {
        break; // a row of fewer words, or a blank line
      }
      if (result.status != RowStatus::Done && word.data() < result.ptr)
      {
        continue; // was decoded
      }
      const bool lost = sinks[sink].open && types[sink] == ValueType::Float64 && is_long(word);
      const RowStatus status = lost ? RowStatus::NotDouble : check_word(word, types[sink]);
      if (status != RowStatus::Done)
      {
        misfits.push_back(misfit(status, column, word, line));
        types[sink] = status == RowStatus::NotExact ? ValueType::Float64 : ValueType::Text;
      }
    }
    from = end + 1;
  }
  if (!misfits.empty())
  {
    throw misfits;
  }
}
}
