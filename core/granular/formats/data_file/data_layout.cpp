// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/data_file/data_layout.h"

#include "granular/common/words.h"
#include "granular/formats/data_file/data_header.h"
#include "granular/formats/data_file/data_text.h"
#include "granular/numbers/number.h"
#include "granular/text/text_scanner.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
using Words = std::vector<std::string_view>;

/// A section whose rows the header counts.
struct CountedSection
{
  std::string_view name;
  std::int64_t DataLayout::*rows;
  bool optional; ///< may be missing where the header counts rows
};

constexpr CountedSection counted_sections[] = {
  { "Atoms", &DataLayout::atoms, false },
  { "Velocities", &DataLayout::atoms, true },
  { "Bonds", &DataLayout::bonds, false },
  { "Ellipsoids", &DataLayout::ellipsoids, false },
};

/// LAMMPS' other sections, but for Coeffs and Type Labels. Molecules and Charges are those of fix property/atom.
constexpr std::string_view other_sections[] = { "Masses", "Lines", "Triangles", "Bodies", "Angles",
  "Dihedrals", "Impropers" };

/// Returns true if a word is written as integers are: "1", and not "1.0" or "1e0".
bool is_whole(std::string_view word) noexcept
{
  return word.find_first_not_of("0123456789", word.starts_with('-') ? 1 : 0) == word.npos;
}

void add_value(std::string_view word, ColumnValues& column)
{
  double value = 0;
  if (!parse_double(word.data(), word.data() + word.size(), value))
  {
    column.words = true;
    return;
  }
  column.lowest = std::min(column.lowest, value);
  column.highest = std::max(column.highest, value);
  column.sum += value;
  column.whole = column.whole && is_whole(word);
}

/// Goes through a data file from its first line to its last one.
class LayoutScan
{
public:
  LayoutScan(const ByteSource& source, Progress& progress)
    : text_(source)
    , scanner_(text_, 0, 1)
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
      this->take_section(line);
    }
    for (const CountedSection& counts : counted_sections)
    {
      const std::int64_t rows = layout_.*counts.rows;
      if (!counts.optional && rows > 0 && !layout_.find(counts.name))
      {
        throw FormatError("expected a section " + std::string(counts.name) + " with " +
            std::to_string(rows) + " rows, got none",
          { text_.path(), scanner_.line() });
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
        { text_.path(), scanner_.line() });
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
    return text_.read(scanner_.offset(), &byte, 1) > 0 ? "a last line without its line feed"
                                                       : "the end of the file";
  }

  /// Passes over a section whose name is in this line.
  void take_section(std::string_view line)
  {
    const Where where = scanner_.where();
    DataSection section;
    section.name = join_words(data_words(line));
    section.comment =
      line.find('#') == line.npos ? "" : join_words(split_words(line.substr(line.find('#') + 1)));
    section.name_line = where.line;
    section.offset = section.end = scanner_.offset();
    section.line = scanner_.line();
    const auto* const counts =
      std::ranges::find(counted_sections, section.name, &CountedSection::name);
    const bool is_counted = counts != std::end(counted_sections);
    const DataSection* const first = layout_.find(section.name);
    if (is_counted && first)
    {
      throw FormatError("expected one section " + section.name +
          ", got another one; the first is in line " + std::to_string(first->name_line),
        where);
    }
    this->pass_rows(section);
    if (is_counted && section.rows != layout_.*counts->rows)
    {
      throw FormatError("expected " + std::to_string(layout_.*counts->rows) +
          " rows in the section " + section.name + ", got " + std::to_string(section.rows) +
          ", then " + this->what_is_next(),
        where);
    }
    layout_.sections.push_back(std::move(section));
  }

  void pass_rows(DataSection& section)
  {
    const Take take = taker_of(section);
    bool comments = false;
    std::string_view line;
    while (this->next(line))
    {
      const char first = first_letter(line);
      comments = comments || line.find('#') != line.npos;
      if (names_section(line) && !this->begins_with_label(line))
      {
        scanner_.put_back();
        return;
      }
      if (first == '\0' || first == '#')
      {
        continue;
      }
      if (section.rows == 0 || take)
      {
        const Words words = data_words(line);
        section.words = section.rows == 0 ? words.size() : section.words;
        if (take)
        {
          (this->*take)(words, section);
        }
      }
      section.has_comments = comments; // those behind the last row do not matter
      section.end = scanner_.offset();
      ++section.rows;
    }
  }

  /// Takes the words of a row.
  using Take = void (LayoutScan::*)(const Words& words, DataSection& section);

  /// Returns what is needed of each row of a section, or null.
  static Take taker_of(const DataSection& section)
  {
    const std::string_view name = section.name;
    const bool guesses =
      name == "Atoms" && (section.comment.empty() || section.comment.starts_with("hybrid"));
    return guesses || !is_known_section(name) ? &LayoutScan::take_values
      : name == "Ellipsoids"                  ? &LayoutScan::count_words
      : name == "Masses"                      ? &LayoutScan::take_mass
      : name.ends_with("Type Labels")         ? &LayoutScan::take_label
                                              : Take();
  }

  void count_words(const Words& words, DataSection& section)
  {
    section.fewest_words =
      section.rows == 0 ? words.size() : std::min(section.fewest_words, words.size());
    section.most_words = std::max(section.most_words, words.size());
  }

  void take_values(const Words& words, DataSection& section)
  {
    section.values.resize(section.words);
    for (std::size_t i = 0; i < std::min(words.size(), section.words); ++i)
    {
      add_value(words[i], section.values[i]);
    }
  }

  void take_mass(const Words& words, DataSection&)
  {
    std::int64_t type = 0;
    double mass = 0;
    if (words.size() < 2 || !is_type(words[0], layout_.find_labels("Atom Type Labels"), type) ||
      !parse_double(words[1].data(), words[1].data() + words[1].size(), mass))
    {
      throw FormatError(
        "expected a type and its mass, got " + quoted(join_words(words)), scanner_.where());
    }
    layout_.masses[type] = mass;
  }

  void take_label(const Words& words, DataSection& section)
  {
    std::int64_t type = 0;
    if (words.size() != 2 || !is_integer(words[0], type))
    {
      throw FormatError(
        "expected a type and its label, got " + quoted(join_words(words)), scanner_.where());
    }
    layout_.labels[section.name][std::string(words[1])] = type;
  }

  /// Returns true if a line is a row that begins with the label of a type: Masses and Pair Coeffs may have such rows.
  bool begins_with_label(std::string_view line) const
  {
    const Words words = data_words(line);
    return !is_known_section(join_words(words)) &&
      std::ranges::any_of(
        layout_.labels, [&](const auto& labels) { return labels.second.contains(words[0]); });
  }

  const DataText text_;
  TextScanner scanner_;
  Progress& progress_;
  double size_;
  DataLayout layout_;
};
}

const DataSection* DataLayout::find(std::string_view name) const noexcept
{
  const auto found = std::ranges::find(sections, name, &DataSection::name);
  return found == sections.end() ? nullptr : &*found;
}

const TypeLabels* DataLayout::find_labels(std::string_view name) const noexcept
{
  const auto found = labels.find(name);
  return found == labels.end() ? nullptr : &found->second;
}

bool is_known_section(std::string_view name)
{
  return name.ends_with(" Coeffs") || name.ends_with(" Type Labels") ||
    std::ranges::find(other_sections, name) != std::end(other_sections) ||
    std::ranges::find(counted_sections, name, &CountedSection::name) != std::end(counted_sections);
}

DataLayout read_data_layout(const ByteSource& source, Progress& progress)
{
  return LayoutScan(source, progress).read();
}
}
