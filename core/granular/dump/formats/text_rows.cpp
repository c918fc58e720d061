// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/formats/text_rows.h"

#include "granular/dump/formats/text_dump.h"
#include "granular/dump/formats/text_header.h"
#include "granular/text/line_scan.h"
#include "granular/text/text_scanner.h"

#include <algorithm>
#include <string>
#include <utility>

namespace granular
{
namespace
{
/// Significant digits of a real number, as they are written; 0 of an integer, or what is no number.
int digits_of(std::string_view word) noexcept
{
  bool is_real = false;
  int digits = 0;
  for (const char c : word)
  {
    if (c == 'e' || c == 'E')
    {
      is_real = true;
      break;
    }
    is_real = is_real || c == '.';
    digits += c >= '0' && c <= '9' && (digits > 0 || c != '0') ? 1 : 0;
  }
  return is_real ? digits : 0;
}

}

TextRows::TextRows(const ByteSource& source, const FrameEntry& entry)
  : source_(source)
  , entry_(entry)
{
  if (entry.kind->layout == FrameKind::bare)
  {
    header_.timestep = entry.timestep;
    header_.rows = entry.rows;
    header_.has_box = false;
    rows_offset_ = entry.offset;
    rows_line_ = entry.line;
    return;
  }
  check_header(source.path(), entry, header_, this->read_header());
  header_.units = entry.kind->units;
}

/// The words of the first row, if there is one, until the scanner moves on.
std::vector<std::string_view> TextRows::first_row(TextScanner& scanner) const
{
  std::vector<std::string_view> words;
  std::string_view line;
  while (header_.rows > 0 && words.empty() && scanner.next(line))
  {
    append_words(line, words);
  }
  return words;
}

/// Returns the names of the columns. Where the first row makes other columns of them than the index says, the header gets -1 rows.
std::vector<std::string> TextRows::read_header()
{
  constexpr std::size_t window = 4096; // most headers are shorter
  TextScanner scanner(source_, entry_.offset, entry_.line, window);
  TextHeader reader(scanner, "", RowsOf::Any);
  try
  {
    if (!reader.read())
    {
      reader.header().rows = -1; // not what the index says
    }
  }
  catch (const FormatError& error)
  {
    if (error.where().byte >= 0)
    {
      throw; // compressed data that are damaged
    }
    reader.header().rows = -1;
  }
  header_ = std::move(reader.header());
  rows_offset_ = scanner.offset();
  rows_line_ = scanner.line();
  const bool is_header = header_.rows >= 0;
  if (is_header &&
    !makes_columns(reader.column_names(), this->first_row(scanner), entry_.kind->schema))
  {
    header_.rows = -1;
  }
  return reader.column_names();
}

std::vector<int> TextRows::digits() const
{
  constexpr std::int64_t most_bytes = 4096; // some dozen rows
  constexpr int most = 17;                  // more tell doubles no more
  std::vector<int> digits(entry_.kind->schema.columns().size());
  std::string text(
    static_cast<std::size_t>(std::clamp(entry_.end - rows_offset_, std::int64_t{ 0 }, most_bytes)),
    ' ');
  text.resize(source_.read(rows_offset_, text.data(), text.size()));
  std::string_view rest = text;
  std::vector<std::string_view> words;
  for (std::size_t end = rest.find('\n'); end != rest.npos; end = rest.find('\n'))
  {
    words.clear();
    append_words(rest.substr(0, end), words);
    for (std::size_t i = 0; i < std::min(words.size(), digits.size()); ++i)
    {
      digits[i] = std::max(digits[i], std::min(digits_of(words[i]), most));
    }
    rest.remove_prefix(end + 1);
  }
  return digits;
}

std::unique_ptr<RowReader> TextRows::reader() const
{
  return std::make_unique<TextReader>(*this);
}

/// Whether another type of the column holds the word.
bool TextRows::is_mended(const Misfit& misfit) const
{
  return misfit.status == RowStatus::NotExact ||
    (misfit.status == RowStatus::NotANumber &&
      !entry_.kind->schema.columns()[static_cast<std::size_t>(misfit.column)].known);
}

void TextRows::locate(Misfits& misfits) const
{
  const Misfit& first = misfits.front();
  const Where where = this->where(first);
  if (!this->is_mended(first))
  {
    throw FormatError(first.status == RowStatus::NotANumber
        ? "expected a number, got " + quoted(first.word)
        : "expected " + std::to_string(entry_.kind->schema.columns().size()) +
          " words in a row, got " + std::to_string(split_words(first.word).size()),
      where);
  }
  misfits.erase(std::ranges::find_if_not(
                  misfits, [this](const Misfit& misfit) { return this->is_mended(misfit); }),
    misfits.end());
  for (Misfit& misfit : misfits)
  {
    misfit.where = { where.path, where.line + misfit.lines, where.byte, this->name_of(misfit) };
  }
}

/// The line is counted only now.
Where TextRows::where(const Misfit& misfit) const
{
  Where where{ source_.path(), rows_line_ };
  std::int64_t left = misfit.offset - rows_offset_;
  std::string part(std::size_t{ 1 } << 18, ' ');
  for (std::int64_t at = rows_offset_; left > 0;)
  {
    const std::size_t wanted = std::min(part.size(), static_cast<std::size_t>(left));
    const std::size_t got = source_.read(at, part.data(), wanted);
    where.line += std::count(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(got), '\n');
    at += static_cast<std::int64_t>(got);
    left = got == wanted ? left - static_cast<std::int64_t>(got) : 0;
  }
  if (misfit.column >= 0)
  {
    where.column = this->name_of(misfit);
  }
  return where;
}

std::string TextRows::name_of(const Misfit& misfit) const
{
  return entry_.kind->schema.columns()[static_cast<std::size_t>(misfit.column)].name;
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

/// The end of the line that the byte at `at` is in, which is loaded as far as it is not. A line without
/// a line feed at the end of the frame counts as not there.
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
      return line;
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
  surplus_ = false;
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
  const auto columns = static_cast<std::uint32_t>(of_.entry_.kind->schema.columns().size());
  const RowResult result =
    decode_rows(buffer_.data() + at_, buffer_.data() + end_, columns, sinks, max_rows);
  if (result.status != RowStatus::Done)
  {
    this->fail(result, sinks);
  }
  at_ = static_cast<std::size_t>(result.ptr - buffer_.data());
  surplus_ = surplus_ || result.surplus;
  return result.rows;
}

/// Adds to the first misfit those behind its word, which ends at `from`. A column that must change is looked at as what it
/// becomes.
void TextReader::find_misfits(
  const char* from, std::span<const ColumnSink> sinks, Misfits& misfits) const
{
  std::vector<ValueType> types;
  std::ranges::transform(sinks, std::back_inserter(types), &ColumnSink::type);
  const auto change = [&](std::size_t sink, RowStatus status)
  { types[sink] = status == RowStatus::NotExact ? ValueType::Float64 : ValueType::Text; };
  int column = misfits.front().column; // that of the last word that was taken
  const auto first = std::ranges::find_if(
    sinks, [&](const ColumnSink& sink) { return static_cast<int>(sink.column) == column; });
  change(static_cast<std::size_t>(first - sinks.begin()), misfits.front().status);
  const char* const last = buffer_.data() + end_;
  for (std::int64_t line = 0; from < last; ++line, column = -1)
  {
    const char* const end = std::find(from, last, '\n');
    std::string_view rest(from, end);
    for (std::size_t sink = 0; sink < sinks.size(); ++sink)
    {
      if (column >= static_cast<int>(sinks[sink].column))
      {
        continue;
      }
      std::string_view word;
      for (; column < static_cast<int>(sinks[sink].column); ++column)
      {
        word = take_word(rest);
      }
      if (word.empty())
      {
        break; // a row of fewer words, or a blank line
      }
      const RowStatus status = check_word(word, types[sink]);
      if (status != RowStatus::Done)
      {
        misfits.push_back(
          { status, column, std::string(word), offset_ + (word.data() - buffer_.data()), line });
        change(sink, status);
      }
    }
    from = end + 1;
  }
}

void TextReader::fail(const RowResult& result, std::span<const ColumnSink> sinks) const
{
  const char* const last = buffer_.data() + end_;
  const char* const end = result.status == RowStatus::TooFew
    ? std::find(result.ptr, last, '\n')
    : std::find_if(result.ptr, last, is_blank);
  const bool too_few = result.status == RowStatus::TooFew;
  Misfits misfits = { { result.status, too_few ? -1 : result.column, std::string(result.ptr, end),
    offset_ + (result.ptr - buffer_.data()) } };
  if (!too_few)
  {
    this->find_misfits(end, sinks, misfits);
  }
  throw misfits;
}
}
