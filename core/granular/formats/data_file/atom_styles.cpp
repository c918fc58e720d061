// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/data_file/read_data.h"

#include "granular/common/words.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <span>

namespace granular
{
namespace
{
using Words = std::vector<std::string_view>;

constexpr std::string_view image_columns = "ix iy iz";
constexpr std::string_view ellipsoids =
  "id shapex shapey shapez quatw quati quatj quatk"; // LAMMPS since 2026: exponents may follow
constexpr std::string_view exponents = "block1 block2";
constexpr std::string_view spins = "id vx vy vz omegax omegay omegaz";

/// The columns of the sections Atoms and Velocities in an atom style, with the names in dumps. Three image counts ix iy iz
/// may follow in all rows of Atoms.
struct AtomStyle
{
  std::string_view name;
  std::string_view columns;
  std::string_view velocities = "id vx vy vz";
  bool has_bonds = false; ///< particles of the style may have bonds
};

/// From the documentation of LAMMPS (read_data) and the sources of LIGGGHTS.
constexpr AtomStyle styles[] = {
  { .name = "atomic", .columns = "id type x y z" },
  { .name = "charge", .columns = "id type q x y z" },
  { .name = "bond", .columns = "id mol type x y z", .has_bonds = true },
  { .name = "angle", .columns = "id mol type x y z", .has_bonds = true },
  { .name = "molecular", .columns = "id mol type x y z", .has_bonds = true },
  { .name = "full", .columns = "id mol type q x y z", .has_bonds = true },
  { .name = "sphere", .columns = "id type diameter density x y z", .velocities = spins },
  { .name = "granular", .columns = "id type diameter density x y z", .velocities = spins },
  { .name = "ellipsoid",
    .columns = "id type ellipsoidflag density x y z",
    .velocities = "id vx vy vz angmomx angmomy angmomz" },
};

/// Columns whose numbers are written as integers.
constexpr std::string_view integers[] = { "id", "mol", "type", "ellipsoidflag", "ix", "iy", "iz" };

/// The columns of rows of so many words: with image counts, or without; none where a style has others.
Words columns_of(const AtomStyle& style, std::size_t words)
{
  Words columns = split_words(style.columns);
  if (words == columns.size() + 3)
  {
    append_words(image_columns, columns);
  }
  return columns.size() == words ? columns : Words();
}

/// Returns true if a word is written as integers are: "1", and not "1.0" or "1e0".
bool is_whole(std::string_view word) noexcept
{
  return word.find_first_not_of("0123456789", word.starts_with('-') ? 1 : 0) == word.npos;
}

/// Returns true if the rows may be those of a style: as many words, integers where columns are, and as many velocities.
bool fits(const AtomStyle& style, const DataLayout& layout)
{
  const Words row = split_words(layout.particles->first_row);
  const Words columns = columns_of(style, row.size());
  if (columns.empty() || (layout.bonds > 0 && !style.has_bonds))
  {
    return false;
  }
  for (std::size_t i = 0; i < row.size(); ++i)
  {
    if (std::ranges::find(integers, columns[i]) != std::end(integers) && !is_whole(row[i]))
    {
      return false;
    }
  }
  return !layout.velocities ||
    split_words(layout.velocities->first_row).size() == split_words(style.velocities).size();
}

std::string names_of(std::span<const AtomStyle> list)
{
  return join_words(list, " ", &AtomStyle::name);
}

std::vector<AtomStyle> styles_that_fit(const DataLayout& layout)
{
  std::vector<AtomStyle> fitting(std::begin(styles), std::end(styles));
  std::erase_if(fitting, [&](const AtomStyle& style) { return !fits(style, layout); });
  return fitting;
}

/// "those of sphere granular fit: set AtomStyle".
std::string advice(const DataLayout& layout)
{
  const std::vector<AtomStyle> fitting = styles_that_fit(layout);
  return fitting.empty() ? "none of these fits the first rows: make a dump of the file"
                         : "those of " + names_of(fitting) + " fit the first rows: set AtomStyle";
}

/// The only style that fits, up to others with the same columns.
AtomStyle guess(const DataLayout& layout, const Where& where, Notices& notices)
{
  const std::vector<AtomStyle> fitting = styles_that_fit(layout);
  std::set<std::string_view> columns;
  std::ranges::transform(fitting, std::inserter(columns, columns.end()), &AtomStyle::columns);
  const std::size_t words = split_words(layout.particles->first_row).size();
  if (columns.size() != 1)
  {
    throw FormatError("expected the atom style as in 'Atoms # sphere', got none, and rows of " +
        std::to_string(words) + " words; of the styles " + names_of(styles) + ", " + advice(layout),
      where);
  }
  notices.push_back({ where,
    "the atom style is not in the file: the columns are taken for those of " + names_of(fitting) +
      ", " + join_words(columns_of(fitting.front(), words)) +
      "; if they are others, set AtomStyle" });
  return fitting.front();
}

std::vector<std::string> to_strings(const Words& words)
{
  return { words.begin(), words.end() };
}

/// The columns of the section Ellipsoids.
std::vector<std::string> find_ellipsoid_columns(const DataLayout& layout, const std::string& path)
{
  if (!layout.ellipsoid_rows || layout.ellipsoid_rows->rows == 0)
  {
    return {};
  }
  Words columns = split_words(ellipsoids);
  const std::size_t words = layout.ellipsoid_rows->fewest_words;
  if (words == columns.size() + 2)
  {
    append_words(exponents, columns);
  }
  if (words != columns.size())
  {
    throw FormatError(
      "expected rows of 8 or 10 words in the section Ellipsoids, got " + std::to_string(words),
      { path, layout.ellipsoid_rows->name_line });
  }
  return to_strings(columns);
}
}

DataColumns find_data_columns(
  const DataLayout& layout, std::string_view asked, const std::string& path, Notices& notices)
{
  const bool automatic = asked.empty() || asked == "automatic";
  const Where where{ path, layout.particles ? layout.particles->name_line : 1 };
  const std::string named =
    automatic ? (layout.particles ? layout.particles->comment : "") : std::string(asked);
  const auto known = std::ranges::find(styles, named, &AtomStyle::name);
  if (known == std::end(styles) && !named.empty())
  {
    throw FormatError("expected an atom style of " + names_of(styles) + ", got " + quoted(named) +
        (layout.particles ? "; " + advice(layout) : ""),
      where);
  }
  if (!layout.particles)
  {
    return { to_strings(split_words((known == std::end(styles) ? styles[0] : *known).columns)), {},
      {} };
  }
  const bool empty = layout.particles->rows == 0;
  const AtomStyle style = known != std::end(styles) ? *known
    : empty                                         ? styles[0]
                                                    : guess(layout, where, notices);
  const std::size_t usual = split_words(style.columns).size();
  const std::size_t words = empty ? usual : split_words(layout.particles->first_row).size();
  DataColumns columns{ to_strings(columns_of(style, words)), {},
    find_ellipsoid_columns(layout, path) };
  if (columns.particles.empty())
  {
    throw FormatError("expected rows of " + std::to_string(usual) + " or " +
        std::to_string(usual + 3) + " words, as atom style " + named + " has them (" +
        std::string(style.columns) + ", and image counts), got " + std::to_string(words) + "; " +
        advice(layout),
      where);
  }
  if (layout.velocities)
  {
    columns.velocities = to_strings(split_words(style.velocities));
  }
  return columns;
}
}
