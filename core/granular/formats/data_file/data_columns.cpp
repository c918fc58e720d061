// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/data_file/read_data.h"

#include "granular/common/words.h"
#include "granular/formats/data_file/atom_styles.h"
#include "granular/lines/line_columns.h"

#include <algorithm>
#include <iterator>

namespace granular
{
namespace
{
using Words = std::vector<std::string_view>;
using Strings = std::vector<std::string>;

constexpr std::string_view ellipsoids =
  "id shapex shapey shapez quatw quati quatj quatk"; // LAMMPS since 2026: exponents may follow
constexpr std::string_view exponents = "block1 block2";

/// Returns true if types have masses: LAMMPS writes 0 where each particle has its own.
bool has_masses(const DataLayout& layout)
{
  return std::ranges::any_of(layout.masses, [](const auto& mass) { return mass.second != 0; });
}

Strings to_strings(const Words& words)
{
  return { words.begin(), words.end() };
}

Strings find_ellipsoid_columns(const DataSection& section, const std::string& path)
{
  if (section.rows == 0)
  {
    return {};
  }
  Words columns = split_words(ellipsoids);
  if (section.fewest_words == columns.size() + 2)
  {
    append_words(exponents, columns);
  }
  if (section.fewest_words != columns.size())
  {
    throw FormatError("expected rows of 8 or 10 words in the section Ellipsoids, got " +
        std::to_string(section.fewest_words),
      { path, section.name_line });
  }
  return to_strings(columns);
}

/// Returns true if fix property/atom may have several values a particle under this name of the user's; marked: it must.
bool may_be_array(std::string_view name, bool marked = false)
{
  return name.starts_with("i2_") || name.starts_with("d2_") ||
    (!marked && (name.starts_with("i_") || name.starts_with("d_")));
}

/// Returns the columns with these names, as dumps name them, where one of them has `more` values more than one.
Strings property_columns(const Words& names, std::string_view array, std::size_t more)
{
  Strings columns = { "id" };
  for (const std::string_view name : names)
  {
    if (more == 0 || name != array)
    {
      columns.emplace_back(name == "rmass" ? "mass" : name);
    }
    for (std::size_t i = 0; more > 0 && name == array && i <= more; ++i)
    {
      columns.push_back(std::string(name.substr(0, 1)) + "2" +
        std::string(name.substr(name.find('_'))) + "[" + std::to_string(i + 1) + "]");
    }
  }
  return columns;
}

/// Returns the columns of a section of fix property/atom; none if it is another one. LAMMPS writes the name of an array once, and as
/// d_pos that of d2_pos[1], d2_pos[2] and so on: the last name is taken for it of those where integers are whole.
Strings find_property_columns(const DataSection& section, const std::string& path, Notices& notices)
{
  constexpr std::string_view single[] = { "mol", "q", "rmass", "temperature", "heatflow" };
  const Words names = split_words(section.name == "Molecules" ? "mol"
      : section.name == "Charges"                             ? "q"
                                                              : std::string_view(section.comment));
  const bool is_known = std::ranges::all_of(names,
    [&](std::string_view name)
    { return may_be_array(name) || std::ranges::find(single, name) != std::end(single); });
  if (names.empty() || !is_known || section.words <= names.size() || is_known_section(section.name))
  {
    return {};
  }
  const std::size_t more = section.words - 1 - names.size();
  const bool marked =
    std::ranges::any_of(names, [](std::string_view name) { return may_be_array(name, true); });
  std::vector<Strings> fitting;
  for (const std::string_view name : names)
  {
    const Strings columns = property_columns(names, name, more);
    bool fits = columns.size() == section.words && (more == 0 || may_be_array(name, marked));
    for (std::size_t i = 0; fits && i < columns.size(); ++i)
    {
      fits = !columns[i].starts_with('i') || section.values[i].whole;
    }
    if (fits)
    {
      fitting.push_back(columns);
    }
  }
  if (more > 0 && fitting.size() > 1)
  {
    notices.push_back({ { path, section.name_line },
      "the section " + section.name + " has " + std::to_string(section.words - 1) +
        " values a particle and " + std::to_string(names.size()) +
        " names: the columns are taken for " + join_words(fitting.back()) });
  }
  return fitting.empty() ? Strings() : fitting.back();
}

/// Finds the style of the section Atoms, and its columns.
Style find_style(const DataLayout& layout, const DataSection* atoms, std::string_view asked,
  const Where& where, Notices& notices)
{
  const std::string text = asked.empty() && atoms ? atoms->comment : std::string(asked);
  const std::optional<Style> named = named_style(text, asked.empty(), layout, where);
  if (!atoms || atoms->rows == 0)
  {
    return named.value_or(style_of(atom_styles().front()));
  }
  Style style = named ? *named : guess_style(layout, !text.empty(), where, notices);
  if (style.columns_of(atoms->words).empty())
  {
    const std::size_t usual = style.columns.size();
    throw FormatError("expected rows of " + std::to_string(usual) + " or " +
        std::to_string(usual + 3) + " words, as atom style " + style.name + " has them (" +
        join_words(style.columns) + ", and image counts), got " + std::to_string(atoms->words) +
        style_advice(layout),
      where);
  }
  return style;
}

/// Says which sections are not read. Coefficients and labels belong to types, and no particle has them.
void note_skipped(
  const DataLayout& layout, const DataColumns& columns, const std::string& path, Notices& notices)
{
  std::string names;
  std::int64_t line = 0;
  for (const DataSection& section : layout.sections)
  {
    const bool is_read = section.rows == 0 || section.name == "Atoms" || section.name == "Bonds" ||
      section.name.ends_with(" Coeffs") || section.name.ends_with(" Type Labels") ||
      (section.name == "Masses" && (columns.masses || !has_masses(layout))) ||
      std::ranges::find(columns.joined, &section, &JoinedSection::section) != columns.joined.end();
    if (!is_read)
    {
      line = names.empty() ? section.name_line : line;
      names +=
        (names.empty() ? "" : ", ") + section.name + " (" + std::to_string(section.rows) + " rows)";
    }
  }
  if (!names.empty())
  {
    notices.push_back({ { path, line }, "sections that are not read: " + names });
  }
}
}

DataColumns find_data_columns(
  const DataLayout& layout, std::string_view asked, const std::string& path, Notices& notices)
{
  const DataSection* const atoms = layout.find("Atoms");
  const Where where{ path, atoms ? atoms->name_line : 1 };
  const Style style = find_style(layout, atoms, asked == "automatic" ? "" : asked, where, notices);
  const bool empty = !atoms || atoms->rows == 0;
  DataColumns columns{ to_strings(empty ? style.columns : style.columns_of(atoms->words)) };
  for (const DataSection& section : layout.sections)
  {
    const bool velocities = section.name == "Velocities";
    Strings own = velocities         ? to_strings(style.velocities)
      : section.name == "Ellipsoids" ? find_ellipsoid_columns(section, path)
                                     : find_property_columns(section, path, notices);
    if (!own.empty() && (velocities || section.rows > 0))
    {
      columns.joined.push_back({ &section, std::move(own), velocities });
    }
  }
  const auto has = [&](std::string_view name)
  { return std::ranges::find(columns.particles, name) != columns.particles.end(); };
  columns.masses = has_masses(layout) && !has("density") && !has("mass");
  note_skipped(layout, columns, path, notices);
  return columns;
}

ColumnSchema make_particle_schema(const DataColumns& columns)
{
  std::vector<std::string> names = columns.particles;
  for (const JoinedSection& more : columns.joined)
  {
    names.insert(names.end(), more.columns.begin() + 1, more.columns.end());
  }
  if (columns.masses)
  {
    names.emplace_back("mass");
  }
  return ColumnSchema(names);
}

ColumnSchema make_data_bond_schema()
{
  return make_local_schema({ "bond_id", "btype", "id1", "id2" });
}
}
