// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/text_rows.h"

#include "granular/base/text_scanner.h"
#include "granular/dump/text_header.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

namespace granular
{
TextRows::TextRows(const ByteSource& source, const FrameEntry& entry)
  : source_(source)
  , entry_(entry)
  , buffer_(std::size_t{ 1 } << 18)
{
  check_header(source.path(), entry, header_, this->read_header());
  buffer_offset_ = rows_offset_;
}

/// Returns the names of the columns.
std::vector<std::string> TextRows::read_header()
{
  constexpr std::size_t window = 4096; // most headers are shorter
  TextScanner scanner(source_, entry_.offset, entry_.line, window);
  TextHeader reader(scanner, entry_.kind->units);
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
  return reader.column_names();
}

double TextRows::fraction() const noexcept
{
  const auto bytes = static_cast<double>(entry_.end - rows_offset_);
  const auto done =
    static_cast<double>(buffer_offset_ + static_cast<std::int64_t>(at_) - rows_offset_);
  return bytes > 0 ? done / bytes : 1.0;
}

/// Brings at least one more whole line into the buffer. False at the end of the frame.
bool TextRows::fill()
{
  std::memmove(buffer_.data(), buffer_.data() + at_, end_ - at_);
  buffer_offset_ += static_cast<std::int64_t>(at_);
  end_ -= at_;
  at_ = 0;
  lines_end_ = 0;
  while (lines_end_ == 0)
  {
    const std::int64_t offset = buffer_offset_ + static_cast<std::int64_t>(end_);
    if (end_ == buffer_.size())
    {
      if (buffer_.size() > TextScanner::longest_line)
      {
        throw LimitError("expected rows of at most " + std::to_string(TextScanner::longest_line) +
            " bytes, got a longer one",
          { source_.path(), rows_line_ });
      }
      buffer_.resize(2 * buffer_.size());
    }
    const auto left = static_cast<std::size_t>(entry_.end - offset);
    const std::size_t wanted = std::min(left, buffer_.size() - end_);
    const std::size_t got = source_.read(offset, buffer_.data() + end_, wanted);
    if (got < wanted)
    {
      throw IoError("the file was shortened while it was read: expected " +
          std::to_string(entry_.end) + " bytes, got " +
          std::to_string(offset + static_cast<std::int64_t>(got)),
        { source_.path() });
    }
    if (got == 0)
    {
      return false;
    }
    const std::size_t feed = std::string_view(buffer_.data() + end_, got).rfind('\n');
    lines_end_ = feed == std::string_view::npos ? 0 : end_ + feed + 1;
    end_ += got;
  }
  return true;
}

std::int64_t TextRows::decode(std::span<ColumnSink> sinks, std::int64_t max_rows)
{
  const auto columns = static_cast<std::uint32_t>(entry_.kind->schema.columns().size());
  for (;;)
  {
    if (at_ == lines_end_ && !this->fill())
    {
      this->check_count(rows_);
      return 0;
    }
    const std::int64_t left = entry_.rows - rows_;
    result_ = decode_rows(buffer_.data() + at_, buffer_.data() + lines_end_, columns,
      left > 0 ? sinks : sinks.first(0), left > 0 ? std::min(max_rows, left) : 1);
    rows_ += result_.rows;
    if (left <= 0)
    {
      this->check_count(rows_);
    }
    surplus_ = surplus_ || result_.surplus;
    at_ = static_cast<std::size_t>(result_.ptr - buffer_.data());
    if (result_.status != RowStatus::Done && !this->is_misfit())
    {
      this->fail();
    }
    if (this->is_misfit())
    {
      return 0;
    }
    if (result_.rows > 0)
    {
      return result_.rows;
    }
  }
}

std::optional<Misfit> TextRows::misfit() const
{
  if (!this->is_misfit())
  {
    return std::nullopt;
  }
  return Misfit{ result_.column, result_.status, std::string(this->word()), this->where() };
}

void TextRows::note(Notices& notices) const
{
  if (surplus_)
  {
    notices.push_back({ { source_.path(), entry_.line },
      "expected " + std::to_string(entry_.kind->schema.columns().size()) +
        " words in a row, got more in some rows; the rest of them was ignored" });
  }
}

bool TextRows::is_misfit() const
{
  return result_.status == RowStatus::NotExact ||
    (result_.status == RowStatus::NotANumber &&
      !entry_.kind->schema.columns()[static_cast<std::size_t>(result_.column)].known);
}

void TextRows::check_count(std::int64_t rows) const
{
  if (rows != entry_.rows)
  {
    throw FormatError("expected " + std::to_string(entry_.rows) + " rows, got " +
        (rows > entry_.rows ? "more" : std::to_string(rows)),
      { source_.path(), entry_.line });
  }
}

std::string_view TextRows::word() const
{
  const char* const end = std::find_if(result_.ptr, buffer_.data() + lines_end_, is_blank);
  return { result_.ptr, static_cast<std::size_t>(end - result_.ptr) };
}

void TextRows::fail() const
{
  if (result_.status == RowStatus::NotANumber)
  {
    throw FormatError("expected a number, got " + quoted(this->word()), this->where());
  }
  const char* const end = std::find(result_.ptr, buffer_.data() + lines_end_, '\n');
  const std::size_t words =
    split_words({ result_.ptr, static_cast<std::size_t>(end - result_.ptr) }).size();
  throw FormatError("expected " + std::to_string(entry_.kind->schema.columns().size()) +
      " words in a row, got " + std::to_string(words),
    this->where());
}

Where TextRows::where() const
{
  Where where{ source_.path(), rows_line_ };
  std::int64_t left = buffer_offset_ + (result_.ptr - buffer_.data()) - rows_offset_;
  std::string part(std::size_t{ 1 } << 18, ' ');
  for (std::int64_t at = rows_offset_; left > 0;)
  {
    const std::size_t wanted = std::min(part.size(), static_cast<std::size_t>(left));
    const std::size_t got = source_.read(at, part.data(), wanted);
    where.line += std::count(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(got), '\n');
    at += static_cast<std::int64_t>(got);
    left = got == wanted ? left - static_cast<std::int64_t>(got) : 0;
  }
  if (result_.column >= 0)
  {
    where.column = entry_.kind->schema.columns()[static_cast<std::size_t>(result_.column)].name;
  }
  return where;
}
}
