// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/data_file/data_layout.h"

#include "granular/common/words.h"
#include "granular/numbers/number.h"
#include "granular/text/text_scanner.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
using Words = std::vector<std::string_view>;

/// A section that is read, and how many rows it must have.
struct KnownSection
{
  std::string_view name;
  std::optional<DataSection> DataLayout::*place;
  std::int64_t DataLayout::*rows;
  bool optional; ///< may be missing where the header counts rows
};

constexpr KnownSection known_sections[] = {
  { "Atoms", &DataLayout::particles, &DataLayout::atoms, false },
  { "Velocities", &DataLayout::velocities, &DataLayout::atoms, true },
  { "Bonds", &DataLayout::bond_rows, &DataLayout::bonds, false },
  { "Ellipsoids", &DataLayout::ellipsoid_rows, &DataLayout::ellipsoids, false },
};

/// The things that the header counts.
constexpr std::pair<std::string_view, std::int64_t DataLayout::*> counted[] = {
  { "atoms", &DataLayout::atoms }, { "bonds", &DataLayout::bonds },
  { "ellipsoids", &DataLayout::ellipsoids }
};

/// A line of the header that describes the box, by the words behind its numbers.
struct BoxLine
{
  std::string_view words;
  std::size_t numbers;
};

enum BoxLines : std::uint8_t
{
  BoundsX,
  BoundsY,
  BoundsZ,
  Tilts,
  VectorA,
  VectorB,
  VectorC,
  Origin,
  BoxLineCount
};

constexpr BoxLine box_lines[BoxLineCount] = { { "xlo xhi", 2 }, { "ylo yhi", 2 }, { "zlo zhi", 2 },
  { "xy xz yz", 3 }, { "avec", 3 }, { "bvec", 3 }, { "cvec", 3 }, { "abc origin", 3 } };

/// The words of a line, less a comment.
Words words_of(std::string_view line)
{
  return split_words(line.substr(0, line.find('#')));
}

/// The first byte of a line that is no blank; 0: there is none.
char first_letter(std::string_view line) noexcept
{
  const auto first = std::ranges::find_if_not(line, is_blank);
  return first == line.end() ? '\0' : *first;
}

/// Rows begin with a number; a word begins a section.
bool names_section(std::string_view line) noexcept
{
  return std::isalpha(static_cast<unsigned char>(first_letter(line))) != 0;
}

bool is_integer(std::string_view word, std::int64_t& value)
{
  return static_cast<bool>(parse_int64(word.data(), word.data() + word.size(), value));
}

/// Takes the facts of the title that write_data makes: "..., timestep = 2000, units = lj".
void take_title(std::string_view title, DataLayout& layout)
{
  const Words words = split_words(title);
  for (std::size_t i = 2; i < words.size(); ++i)
  {
    const std::string_view value = words[i].substr(0, words[i].find(','));
    std::int64_t number = 0;
    if (words[i - 1] == "=" && words[i - 2] == "timestep" && is_integer(value, number))
    {
      layout.timestep = number;
    }
    if (words[i - 1] == "=" && words[i - 2] == "units")
    {
      layout.units = value;
    }
  }
}

/// Takes the lines between the title and the first section.
class HeaderLines
{
public:
  /// Takes a line; those of other things are passed over. Throws FormatError.
  void take(std::string_view line, const Where& where, DataLayout& layout)
  {
    const Words words = words_of(line);
    for (const auto& [name, place] : counted)
    {
      if (words.size() == 2 && words[1] == name)
      {
        if (!is_integer(words[0], layout.*place) || layout.*place < 0)
        {
          throw FormatError(
            "expected a number of " + std::string(name) + ", got " + quoted(words[0]), where);
        }
        counts_atoms = counts_atoms || name == "atoms";
      }
    }
    for (std::size_t i = 0; i < BoxLineCount; ++i)
    {
      const std::size_t numbers = box_lines[i].numbers;
      if (words.size() > numbers &&
        box_lines[i].words ==
          join_words(Words(words.begin() + static_cast<std::ptrdiff_t>(numbers), words.end())))
      {
        numbers_[i] = read_numbers(words, numbers, where);
      }
    }
  }

  Box box() const
  {
    constexpr Vector3 usual = { -0.5, 0.5, 0 };
    if (numbers_[VectorA] && numbers_[VectorB] && numbers_[VectorC])
    {
      return Box::from_vectors(numbers_[Origin].value_or(Vector3{}),
        { *numbers_[VectorA], *numbers_[VectorB], *numbers_[VectorC] });
    }
    const Vector3 x = numbers_[BoundsX].value_or(usual);
    const Vector3 y = numbers_[BoundsY].value_or(usual);
    const Vector3 z = numbers_[BoundsZ].value_or(usual);
    Box box = Box::from_bounds({ x[0], y[0], z[0] }, { x[1], y[1], z[1] });
    if (numbers_[Tilts]) // the bounds are those of the box, not of what is around it as in dumps
    {
      const auto [xy, xz, yz] = *numbers_[Tilts];
      box.tilted = true;
      box.vectors[1][0] = { xy, 0 };
      box.vectors[2][0] = { xz, 0 };
      box.vectors[2][1] = { yz, 0 };
    }
    return box;
  }

  bool counts_atoms = false;

  bool describes_box() const
  {
    return std::ranges::any_of(numbers_, [](const auto& numbers) { return numbers.has_value(); });
  }

private:
  static Vector3 read_numbers(const Words& words, std::size_t count, const Where& where)
  {
    Vector3 numbers = {};
    for (std::size_t i = 0; i < count; ++i)
    {
      if (!parse_double(words[i].data(), words[i].data() + words[i].size(), numbers[i]))
      {
        throw FormatError("expected a number, got " + quoted(words[i]), where);
      }
    }
    return numbers;
  }

  std::array<std::optional<Vector3>, BoxLineCount> numbers_;
};

/// Goes through a data file from its first line to its last one.
class LayoutScan
{
public:
  LayoutScan(const ByteSource& source, Progress& progress)
    : source_(source)
    , scanner_(source, 0, 1)
    , progress_(progress)
    , size_(static_cast<double>(std::max<std::int64_t>(source.stamp().size, 1)))
  {
  }

  DataLayout read()
  {
    this->read_header();
    std::string_view line;
    while (this->next(line))
    {
      if (!names_section(line))
      {
        continue; // a row of a section that is passed over
      }
      const std::string name = join_words(words_of(line));
      const auto known = std::ranges::find(known_sections, name, &KnownSection::name);
      if (known != std::end(known_sections))
      {
        this->take_section(line, *known);
      }
    }
    for (const KnownSection& known : known_sections)
    {
      const std::int64_t rows = layout_.*known.rows;
      if (!known.optional && rows > 0 && !(layout_.*known.place))
      {
        throw FormatError("expected a section " + std::string(known.name) + " with " +
            std::to_string(rows) + " rows, got none",
          { source_.path(), scanner_.line() });
      }
    }
    return layout_;
  }

private:
  void read_header()
  {
    std::string_view line;
    if (this->next(line))
    {
      take_title(line, layout_);
    }
    HeaderLines header;
    while (this->next(line))
    {
      if (names_section(line))
      {
        scanner_.put_back();
        break;
      }
      header.take(line, scanner_.where(), layout_);
    }
    if (!header.counts_atoms)
    {
      throw FormatError("expected a header that counts atoms, got " + this->what_is_next(),
        { source_.path(), scanner_.line() });
    }
    layout_.box = header.box();
  }

  bool next(std::string_view& line)
  {
    constexpr std::int64_t often = 1 << 16;
    if (scanner_.line() % often == 0)
    {
      progress_.step(std::min(1.0, static_cast<double>(scanner_.offset()) / size_));
    }
    return scanner_.next(line);
  }

  /// For errors at the end of a section or of the file. A last line without a line feed may not be complete.
  std::string what_is_next()
  {
    std::string_view line;
    if (scanner_.next(line))
    {
      std::string got = quoted(line);
      scanner_.put_back();
      return got;
    }
    char byte = 0;
    return source_.read(scanner_.offset(), &byte, 1) > 0 ? "a last line without its line feed"
                                                         : "the end of the file";
  }

  /// Passes over the rows of a section, behind the line that names it.
  void take_section(std::string_view line, const KnownSection& known)
  {
    const Where where = scanner_.where();
    const std::string name(known.name);
    std::optional<DataSection>& place = layout_.*known.place;
    if (place)
    {
      throw FormatError("expected one section " + name +
          ", got another one; the first is in line " + std::to_string(place->name_line),
        where);
    }
    place.emplace();
    place->comment =
      line.find('#') == line.npos ? "" : join_words(split_words(line.substr(line.find('#') + 1)));
    place->name_line = where.line;
    place->offset = place->end = scanner_.offset();
    place->line = scanner_.line();
    this->pass_rows(*place, known.place == &DataLayout::ellipsoid_rows);
    const std::int64_t wanted = layout_.*known.rows;
    if (place->rows != wanted)
    {
      throw FormatError("expected " + std::to_string(wanted) + " rows in the section " + name +
          ", got " + std::to_string(place->rows) + ", then " + this->what_is_next(),
        where);
    }
  }

  void pass_rows(DataSection& section, bool counts_words)
  {
    bool comments = false;
    std::string_view line;
    while (this->next(line))
    {
      const char first = first_letter(line);
      comments = comments || line.find('#') != line.npos;
      if (names_section(line))
      {
        scanner_.put_back();
        return;
      }
      if (first == '\0' || first == '#')
      {
        continue;
      }
      if (counts_words)
      {
        const std::size_t words = words_of(line).size();
        section.fewest_words = section.rows == 0 ? words : std::min(section.fewest_words, words);
      }
      section.first_row = section.rows == 0 ? line.substr(0, line.find('#')) : section.first_row;
      section.has_comments = comments; // those behind the last row do not matter
      section.end = scanner_.offset();
      ++section.rows;
    }
  }

  const ByteSource& source_;
  TextScanner scanner_;
  Progress& progress_;
  double size_;
  DataLayout layout_;
};
}

bool starts_data_file(std::string_view first_bytes)
{
  const std::size_t title = first_bytes.find('\n');
  HeaderLines header;
  DataLayout layout;
  for (std::size_t feed = title; feed != first_bytes.npos;)
  {
    const std::size_t next = first_bytes.find('\n', feed + 1);
    const std::string_view line = first_bytes.substr(feed + 1, next - feed - 1);
    if (names_section(line))
    {
      break;
    }
    try
    {
      header.take(line, {}, layout);
    }
    catch (const FormatError&) // says so when it is read
    {
    }
    feed = next;
  }
  return header.counts_atoms && (header.describes_box() || layout.bonds > 0);
}

DataLayout read_data_layout(const ByteSource& source, Progress& progress)
{
  return LayoutScan(source, progress).read();
}
}
