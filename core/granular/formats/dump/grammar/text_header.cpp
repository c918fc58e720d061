// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/grammar/text_header.h"

#include "granular/numbers/number.h"

#include <algorithm>
#include <array>
#include <utility>

namespace granular
{
namespace
{
/// Thrown where the text ends.
struct EndOfText
{
};
}

const TextHeader::Section TextHeader::sections[] = {
  { "TIMESTEP", true, &TextHeader::parse_timestep },
  { "TIME", true, &TextHeader::parse_time },
  { "UNITS", true, &TextHeader::parse_units },
  { "LABEL", true, &TextHeader::parse_label },
  { "NUMBER OF", false, &TextHeader::parse_rows },
  { "GRID SIZE", false, &TextHeader::parse_grid },
  { "BOX BOUNDS", false, &TextHeader::parse_box },
  { "", false, &TextHeader::skip_section },
};

void TextHeader::restart(const std::string& units)
{
  header_.time.reset();
  header_.label.clear();
  header_.counted = rows_of_ == RowsOf::Particles ? "ATOMS" : "";
  header_.units = units;
  header_.cells = {};
  next_line_ = 0;
  opened_ = has_timestep_ = has_rows_ = has_box_ = has_columns_ = flat_ = false;
  others_.reset();
}

bool TextHeader::read()
{
  try
  {
    while (!has_columns_)
    {
      const std::string_view line = this->next();
      if (!(has_comments_ ? says_nothing(line) : !has_words(line)) && line != byte_order_mark)
      {
        this->read_section(line);
      }
    }
  }
  catch (const EndOfText&)
  {
    if (others_)
    {
      throw *others_;
    }
  }
  return has_columns_;
}

/// A section, or what lies between frames, from its first line on.
void TextHeader::read_section(std::string_view line)
{
  // the words outlive the line: the sections read on
  section_ = line;
  words_ = item_words(section_);
  const bool columns = opened_ && !header_.counted.empty() && begins_with(words_, header_.counted);
  const auto section = std::ranges::find_if(sections,
    [this](const Section& entry) { return begins_with(words_, entry.name, entry.alone); });
  if (!opened_ && !words_.empty() && section->name.empty())
  {
    return this->skip_section(); // between frames, or behind the last
  }
  const bool counts = section->parse == &TextHeader::parse_rows;
  const RowsOf counted =
    begins_with(words_, "NUMBER OF ATOMS", true) ? RowsOf::Particles : RowsOf::Others;
  if (counts && rows_of_ != counted && rows_of_ < RowsOf::Cells)
  {
    others_.emplace(std::string("expected ITEM: NUMBER OF ") +
        (rows_of_ == RowsOf::Others ? "ENTRIES, or of other things than ATOMS" : "ATOMS") +
        ", got " + quoted("ITEM: " + join_words(words_)),
      scanner_.where());
    return opened_ ? this->skip_section() : throw *others_;
  }
  if (words_.empty() || (!opened_ && !opens_frame(words_)))
  {
    const std::vector<std::string_view> row = split_words(section_);
    const bool is_row = row.size() > 2 &&
      std::ranges::all_of(row, [](std::string_view word) { return is_number(word); });
    this->fail(opened_ ? "an ITEM: line"
                       : std::string("ITEM: TIMESTEP, UNITS or TIME") +
          (is_row ? ", or ColumnNames for rows without headers" : ""),
      section_);
  }
  if (!opened_)
  {
    opened_ = true;
    offset_ = scanner_.last_offset();
    line_ = scanner_.last_line();
  }
  this->look_for_next_frame();
  columns ? this->parse_columns() : (this->*section->parse)();
}

std::string_view TextHeader::next()
{
  std::string_view line;
  if (!scanner_.next(line))
  {
    throw EndOfText();
  }
  if (const std::size_t glued = find_glued_header(line))
  {
    const Where where = scanner_.where();
    scanner_.go_to(scanner_.last_offset() + static_cast<std::int64_t>(glued), where.line);
    throw FormatError("expected a whole line, got the header of another frame within it", where);
  }
  return line;
}

/// A second ITEM: TIMESTEP is that of another frame, and so are UNITS and TIME that came before it.
void TextHeader::look_for_next_frame()
{
  if (!has_timestep_ || !opens_frame(words_))
  {
    return;
  }
  if (next_line_ == 0)
  {
    next_offset_ = scanner_.last_offset();
    next_line_ = scanner_.last_line();
  }
  if (words_[0] == "TIMESTEP")
  {
    const Where where = scanner_.where();
    scanner_.go_to(next_offset_, next_line_);
    if (others_)
    {
      throw *others_;
    }
    throw FormatError("expected " + this->columns_section() + ", got " + quoted(section_), where);
  }
}

void TextHeader::fail(const std::string& expected, std::string_view got) const
{
  throw FormatError("expected " + expected + ", got " + quoted(got), scanner_.where());
}

/// The line that the header ends with.
std::string TextHeader::columns_section() const
{
  return "ITEM: " + (header_.counted.empty() ? std::string("ENTRIES") : header_.counted);
}

void TextHeader::require(bool seen, const char* section) const
{
  if (!seen)
  {
    throw FormatError(std::string("expected ITEM: ") + section + " before " +
        this->columns_section() + ", got none",
      scanner_.where());
  }
}

/// The next line with words.
std::string_view TextHeader::value_line()
{
  std::string_view line = this->next();
  while (says_nothing(line))
  {
    line = this->next();
  }
  if (line.starts_with(item_mark))
  {
    const std::string copy(line);
    scanner_.put_back();
    this->fail("a value", copy);
  }
  return line;
}

std::int64_t TextHeader::integer(std::string_view word, const std::string& what) const
{
  std::int64_t value = 0;
  if (!parse_int64(word.data(), word.data() + word.size(), value))
  {
    this->fail(what, word);
  }
  return value;
}

void TextHeader::parse_timestep()
{
  std::string_view line = this->value_line(); // some tools add the time as a second word
  const std::string_view word = take_word(line);
  header_.timestep = this->integer(word,
    std::string("an integer timestep") + (is_number(word) ? ", and a time under ITEM: TIME" : ""));
  has_timestep_ = true;
}

void TextHeader::parse_time()
{
  header_.time = this->read_numbers(1)[0];
}

void TextHeader::parse_units()
{
  std::string_view line = this->value_line();
  header_.units = take_word(line);
}

void TextHeader::parse_label()
{
  header_.label = this->next();
}

void TextHeader::parse_rows()
{
  const std::string counted = join_words(std::span(words_).subspan(2));
  const bool particles = counted == "ATOMS";
  if (counted.empty() || rows_of_ == RowsOf::Cells)
  {
    this->fail(rows_of_ == RowsOf::Cells ? "ITEM: GRID SIZE" : "ITEM: NUMBER OF ENTRIES",
      "ITEM: " + join_words(words_));
  }
  header_.counted = counted;
  std::string_view line = this->value_line();
  const std::string_view word = take_word(line);
  const std::string number = std::string("a number of ") + (particles ? "atoms" : "rows");
  header_.rows = this->integer(word, number);
  if (header_.rows < 0)
  {
    this->fail(number + " >= 0", word);
  }
  has_rows_ = true;
}

/// Three counts, along the edges of the box.
void TextHeader::parse_grid()
{
  if (rows_of_ != RowsOf::Cells && rows_of_ != RowsOf::Any)
  {
    this->fail("ITEM: NUMBER OF, of atoms or other things", section_);
  }
  constexpr std::int64_t most = std::int64_t{ 1 } << 40;
  std::string_view line = this->value_line();
  header_.rows = 1;
  for (std::int64_t& count : header_.cells)
  {
    const std::string_view word = take_word(line);
    count = this->integer(word, "three numbers of cells");
    if (count < 1 || count > most / header_.rows)
    {
      this->fail("numbers of cells of 1 and more, 2^40 in all", word);
    }
    header_.rows *= count;
  }
  header_.counted = "GRID CELLS";
  has_rows_ = true;
}

/// "[xy xz yz | abc origin] [flags]" and three lines of 2, 3 or 4 numbers; two lines for two flags, of a box without z.
void TextHeader::parse_box()
{
  std::span<const std::string_view> rest = std::span(words_).subspan(2);
  const bool tilted = begins_with(rest, "xy xz yz");
  const bool general = begins_with(rest, "abc origin");
  rest = rest.subspan(tilted ? 3 : general ? 2 : 0);
  if (std::ranges::any_of(rest, is_misplaced))
  {
    this->fail(
      "BOX BOUNDS, xy xz yz if each line has a tilt behind its bounds, and boundaries such "
      "as pp pp ff",
      section_);
  }
  Spelling spelling;
  std::array<std::array<double, 4>, 3> n = {};
  n[2] = { -0.5, 0.5 };
  header_.box_rounding = {};
  for (std::size_t line = 0; line < n.size(); ++line)
  {
    if (line == 2 && rest.size() == 2)
    {
      flat_ = !item_words(this->next()).empty();
      scanner_.put_back();
      if (flat_)
      {
        break;
      }
    }
    n[line] = this->read_numbers(general ? 4 : tilted ? 3 : 2, &spelling);
    const auto& [lo, hi, tilt, none] = spelling.rounding;
    header_.box_rounding[line] += std::max(lo, hi);
    header_.box_rounding[line == 2 ? 1 : 0] += tilt; // xy and xz, then yz
  }
  if (spelling.digits > fewest_digits) // not printed by %g, which leaves zeros out
  {
    header_.box_rounding = {};
  }
  if (general)
  {
    header_.box = Box::from_vectors({ n[0][3], n[1][3], n[2][3] },
      { Vector3{ n[0][0], n[0][1], n[0][2] }, Vector3{ n[1][0], n[1][1], n[1][2] },
        Vector3{ n[2][0], n[2][1], n[2][2] } });
  }
  else
  {
    const Vector3 lo = { n[0][0], n[1][0], n[2][0] };
    const Vector3 hi = { n[0][1], n[1][1], n[2][1] };
    header_.box = tilted ? Box::from_tilted_bounds(lo, hi, n[0][2], n[1][2], n[2][2])
                         : Box::from_bounds(lo, hi);
  }
  header_.box.boundary = join_words(rest) + (flat_ ? " pp" : "");
  constexpr std::size_t lammps = 22; // characters of its %.16e
  header_.dialect = spelling.shortest >= lammps ? Dialect::Lammps : Dialect::Liggghts;
  has_box_ = true;
}

std::array<double, 4> TextHeader::read_numbers(std::size_t count, Spelling* spelling)
{
  const std::string_view line = this->value_line();
  std::array<std::string_view, 4> words;
  std::size_t there = 0;
  std::string_view rest = line;
  for (auto word = take_word(rest); !word.empty(); word = take_word(rest))
  {
    words[std::min(there++, words.size() - 1)] = word;
  }
  if (there != count)
  {
    this->fail(std::to_string(count) + (count == 1 ? " number" : " numbers"), line);
  }
  std::array<double, 4> numbers = {};
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::string_view word = words[i];
    if (!parse_double(word.data(), word.data() + word.size(), numbers[i]))
    {
      this->fail("a number", word);
    }
    if (spelling)
    {
      spelling->shortest = std::min(spelling->shortest, word.size());
      spelling->digits = std::max(spelling->digits, digits_of(word));
      spelling->rounding[i] = rounding_of(word, numbers[i]);
    }
  }
  return numbers;
}

void TextHeader::parse_columns()
{
  this->require(has_timestep_, "TIMESTEP");
  this->require(has_rows_, "NUMBER OF ATOMS");
  this->require(has_box_ || header_.cells[0] == 0, "BOX BOUNDS");
  header_.has_box = has_box_;
  header_.box = has_box_ ? std::move(header_.box) : Box();
  const auto section = split_words(header_.counted).size();
  column_names_.assign(words_.begin() + static_cast<std::ptrdiff_t>(section), words_.end());
  has_columns_ = true;
}

void TextHeader::skip_section()
{
  while (item_words(this->next()).empty())
  {
  }
  scanner_.put_back();
}
}
