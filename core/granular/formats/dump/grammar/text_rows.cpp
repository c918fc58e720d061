// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/text_rows.h"

#include "granular/formats/dump/grammar/text_dump.h"
#include "granular/formats/dump/grammar/text_header.h"

#include <algorithm>
#include <utility>

namespace granular
{
namespace
{
/// Returns the significant digits of a real number as it is written; 0 of an integer, and of what is no number.
int digits_of_real(std::string_view word) noexcept
{
  return word.find_first_of(".eE") == word.npos ? 0 : digits_of(word);
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
  this->read_header();
  check_header(source.path(), entry, header_, {});
  header_.units = entry.kind->units;
}

/// Reads the header, which gets -1 rows if it or the first row is not what the index says.
void TextRows::read_header()
{
  header_.rows = -1;
  for (const RowsOf rows_of : { RowsOf::Any, RowsOf::Particles, RowsOf::Others })
  {
    if (header_.rows < 0)
    {
      this->read_header(rows_of);
    }
  }
}

void TextRows::read_header(RowsOf rows_of)
{
  constexpr std::size_t window = 4096; // most headers are shorter
  TextScanner scanner(source_, entry_.offset, entry_.line, window);
  TextHeader reader(scanner, "", rows_of);
  bool is_header = false;
  try
  {
    is_header = reader.read();
  }
  catch (const FormatError& error)
  {
    if (error.where().byte >= 0)
    {
      throw; // compressed data that are damaged
    }
  }
  rows_offset_ = scanner.offset();
  rows_line_ = scanner.line();
  is_header = is_header && makes_columns(reader, scanner, entry_.kind->schema);
  header_ = std::move(reader.header());
  header_.rows = is_header ? header_.rows : -1;
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
      digits[i] = std::max(digits[i], std::min(digits_of_real(words[i]), most));
    }
    rest.remove_prefix(end + 1);
  }
  return digits;
}

std::unique_ptr<RowReader> TextRows::reader() const
{
  return std::make_unique<TextReader>(*this);
}

/// Returns true if another type of the column holds the word.
bool TextRows::is_mended(const Misfit& misfit) const
{
  return misfit.status == RowStatus::NotExact || misfit.status == RowStatus::NotDouble ||
    (misfit.status == RowStatus::NotANumber &&
      !entry_.kind->schema.columns()[static_cast<std::size_t>(misfit.column)].known);
}

/// Returns the line of a word, as far as it is not very long.
std::string TextRows::row_of(const Misfit& misfit) const
{
  constexpr std::int64_t reach = 4096;
  const std::int64_t from = std::max(rows_offset_, misfit.offset - reach);
  const auto before = static_cast<std::size_t>(misfit.offset - from);
  std::string text(before + reach, ' ');
  text.resize(source_.read(from, text.data(), text.size()));
  text.resize(std::min(text.find('\n', before), text.size()));
  return text.substr(text.substr(0, before).rfind('\n') + 1);
}

void TextRows::locate(Misfits& misfits) const
{
  const Misfit& first = misfits.front();
  const Where where = this->where(first);
  if (!this->is_mended(first))
  {
    const std::size_t columns = entry_.kind->schema.columns().size();
    const std::string expected = "expected " + std::to_string(columns) + " words in a row";
    const std::string row = this->row_of(first);
    std::string apart = row;
    std::ranges::replace(apart, ',', ' ');
    const bool joined = first.word.ends_with(',') || split_words(row).size() < columns;
    if (joined && apart != row && split_words(apart).size() == columns)
    {
      throw FormatError(
        expected + ", separated by blanks, got values separated by commas: " + quoted(row),
        { where.path, where.line });
    }
    throw FormatError(first.status == RowStatus::NotANumber
        ? "expected a number, got " + quoted(first.word)
        : expected + ", got " + std::to_string(split_words(row.substr(0, row.find('#'))).size()),
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
}
