// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/local/local_presets.h"

#include "granular/common/words.h"
#include "granular/lines/line_columns.h"
#include "granular/numbers/number.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace granular
{
namespace
{
// Names of the fields: property/local of LIGGGHTS prints batom1 batom2 btype, of WITH-BONDS and PFM also places and forces,
// of Flexible_Fibers also torques; pair/gran/local and wall/gran/local print pos, id and force in this order.
constexpr LocalPreset presets[] = {
  { "BondIds", "id1 id2 btype" },
  { "BondTypeIds", "btype id1 id2" },
  { "Bonds", "x1 y1 z1 x2 y2 z2 id1 id2 btype" },
  { "BondsForce", "x1 y1 z1 x2 y2 z2 id1 id2 btype forcex forcey forcez" },
  { "BondsForceTorque",
    "x1 y1 z1 x2 y2 z2 id1 id2 btype forcex forcey forcez torquex torquey torquez "
    "equilibrium_length" },
  { "Contacts", "x1 y1 z1 x2 y2 z2 id1 id2 periodic" },
  { "ContactsForce", "x1 y1 z1 x2 y2 z2 id1 id2 periodic forcex forcey forcez" },
  { "WallContacts", "x1 y1 z1 x2 y2 z2 mesh triangle id2" },
  { "WallContactsForce", "x1 y1 z1 x2 y2 z2 mesh triangle id2 forcex forcey forcez" },
  { "BondIdsForce", "id1 id2 btype dist engpot forcex forcey forcez" },
  { "BondTypeIdsForce", "btype id1 id2 dist engpot forcex forcey forcez" },
};

bool says_something(const std::string& name)
{
  return find_known_column(local_name(name), local_known_columns()) != nullptr;
}

/// The columns that a preset names, if there are as many as it has: those whose names say nothing, or all.
std::vector<std::size_t> columns_for(
  const LocalPreset& preset, const std::vector<std::string>& columns, bool all)
{
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    if (all || !says_something(columns[i]))
    {
      places.push_back(i);
    }
  }
  return places.size() == split_words(preset.columns).size() ? places : std::vector<std::size_t>();
}

/// Every second row of a sample; none if they are too few to tell anything.
LocalSample half_of(const LocalSample& sample, std::size_t first)
{
  constexpr std::size_t least_rows = 6;
  LocalSample half = { .box = sample.box, .has_box = sample.has_box };
  const std::size_t width = sample.rows == 0 ? 0 : sample.values.size() / sample.rows;
  for (std::size_t row = first; sample.rows >= least_rows && row < sample.rows; row += 2)
  {
    const auto from = sample.values.begin() + static_cast<std::ptrdiff_t>(row * width);
    half.values.insert(half.values.end(), from, from + static_cast<std::ptrdiff_t>(width));
    ++half.rows;
  }
  return half;
}

std::string describe(const LocalPreset& preset)
{
  return std::string(preset.name) + " (" + std::string(preset.columns) + ")";
}

/// Words of a list that blanks and commas separate.
std::vector<std::string> words_of_list(const std::string& list)
{
  std::string spaced = list;
  std::ranges::replace(spaced, ',', ' ');
  const std::vector<std::string_view> words = split_words(spaced);
  return { words.begin(), words.end() };
}

/// The names as a set. Throws FormatError where there is one twice.
std::set<std::string_view> check_distinct(const std::vector<std::string>& names)
{
  std::set<std::string_view> seen;
  for (const std::string& name : names)
  {
    if (!seen.insert(name).second)
    {
      throw FormatError("expected each name once in the column map, got '" + name + "' twice");
    }
  }
  return seen;
}

/// The column that a word of a map means, by name or number.
std::size_t column_of(const std::vector<std::string>& columns, const std::string& word)
{
  const auto found = std::ranges::find(columns, word);
  if (found != columns.end())
  {
    return static_cast<std::size_t>(found - columns.begin());
  }
  std::int64_t number = 0;
  if (parse_int64(word.data(), word.data() + word.size(), number) && number >= 1 &&
    number <= static_cast<std::int64_t>(columns.size()))
  {
    return static_cast<std::size_t>(number - 1);
  }
  throw FormatError("expected a column, or its number from 1 to " + std::to_string(columns.size()) +
    ", in the column map, got '" + word + "'; the columns are " + join_words(columns));
}

std::vector<std::string> name_by_pairs(
  const std::vector<std::string>& columns, const std::vector<std::string>& pairs)
{
  std::vector<std::string> names = name_columns(columns);
  std::map<std::size_t, std::string> given;
  std::vector<std::string> all;
  for (const std::string& pair : pairs)
  {
    const std::size_t equals = pair.find('=');
    if (equals == pair.npos || equals == 0 || equals + 1 == pair.size())
    {
      throw FormatError(
        "expected NAME=COLUMN in the column map, as in its other words, got '" + pair + "'");
    }
    const std::string name(local_name(pair.substr(0, equals)));
    const std::size_t column = column_of(columns, pair.substr(equals + 1));
    if (!given.emplace(column, name).second)
    {
      throw FormatError("expected each column once in the column map, got " + columns[column] +
        " as '" + given[column] + "' and as '" + name + "'");
    }
    all.push_back(name);
  }
  const std::set<std::string_view> taken = check_distinct(all);
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const auto found = given.find(i);
    if (found != given.end())
    {
      names[i] = found->second;
    }
    else if (taken.contains(names[i]))
    {
      // its name is another column's now, perhaps also as the file spells it
      names[i] = columns[i] + (taken.contains(columns[i]) ? "_file" : "");
    }
  }
  return names;
}
}

std::span<const LocalPreset> local_presets() noexcept
{
  return presets;
}

std::vector<std::string> name_columns(const std::vector<std::string>& columns)
{
  std::vector<std::string> names;
  for (const std::string& column : columns)
  {
    names.emplace_back(local_name(column));
  }
  return names;
}

std::vector<std::string> name_columns(
  const std::vector<std::string>& columns, const LocalPreset& preset)
{
  std::vector<std::size_t> places = columns_for(preset, columns, false);
  places = places.empty() ? columns_for(preset, columns, true) : places;
  if (columns.empty())
  {
    const std::vector<std::string_view> names = split_words(preset.columns);
    return { names.begin(), names.end() };
  }
  if (places.empty())
  {
    throw FormatError("expected the " + std::to_string(split_words(preset.columns).size()) +
      " columns of the preset " + describe(preset) + ", got " + std::to_string(columns.size()) +
      ": " + join_words(columns));
  }
  std::vector<std::string> names = name_columns(columns);
  std::size_t next = 0;
  for (const std::string_view name : split_words(preset.columns))
  {
    names[places[next++]] = name;
  }
  return names;
}

std::vector<std::string> name_columns(
  const std::vector<std::string>& columns, const std::string& map)
{
  const std::vector<std::string> words = words_of_list(map);
  if (std::ranges::any_of(
        words, [](const std::string& word) { return word.find('=') != word.npos; }))
  {
    return columns.empty() ? columns : name_by_pairs(columns, words);
  }
  std::vector<std::string> names = expand_keywords(words, columns.size());
  if (names.size() != columns.size() && !columns.empty())
  {
    throw FormatError("expected a name for each of " + std::to_string(columns.size()) +
      " columns in the column map, got " + std::to_string(names.size()) + ": " + join_words(names) +
      "; the columns are " + join_words(columns));
  }
  check_distinct(names);
  return names;
}

bool maps_lines(const std::string& map)
{
  std::vector<std::string> words = words_of_list(map);
  for (std::string& word : words)
  {
    word.resize(std::min(word.find('='), word.size()));
  }
  // `id` is also a keyword of contacts; particles alone have a place of their own
  const auto is_place = [](const std::string& word)
  {
    const KnownColumn* const known = find_known_column(word);
    return known != nullptr && is_position(known->role);
  };
  return std::ranges::none_of(words, is_place) && say_what_they_are(expand_keywords(words, 0));
}

bool say_what_they_are(const std::vector<std::string>& columns)
{
  const ColumnSchema schema = make_local_schema(name_columns(columns));
  return has_ids(schema) || has_ends(schema);
}

std::vector<std::string> find_columns(const std::vector<std::string>& columns,
  const LocalSample& sample, const Where& where, Notices& notices)
{
  if (sample.rows == 0 || say_what_they_are(columns))
  {
    return name_columns(columns);
  }
  const LocalSample halves[] = { half_of(sample, 0), half_of(sample, 1) };
  std::vector<const LocalPreset*> as_long;
  std::vector<const LocalPreset*> fitting;
  std::vector<const LocalPreset*> nearly; // but for rows of one half
  for (const LocalPreset& preset : presets)
  {
    const std::vector<std::size_t> places = columns_for(preset, columns, false);
    if (!places.empty())
    {
      as_long.push_back(&preset);
      if (fits(preset, places, columns.size(), sample))
      {
        fitting.push_back(&preset);
      }
      else if (std::ranges::any_of(halves,
                 [&](const LocalSample& half)
                 { return half.rows > 0 && fits(preset, places, columns.size(), half); }))
      {
        nearly.push_back(&preset);
      }
    }
  }
  const bool is_broken = fitting.empty() && !nearly.empty();
  if (fitting.size() > 1 || is_broken)
  {
    throw FormatError("expected columns whose names say what they hold, got " +
        join_words(columns) + "; " +
        (is_broken ? "no preset fits the values, but for a few rows: "
                   : "several presets fit the values: ") +
        join_words(is_broken ? nearly : fitting, " ",
          [](const LocalPreset* preset) { return describe(*preset); }) +
        "; set Preset or ColumnMap",
      where);
  }
  if (fitting.empty())
  {
    notices.push_back({ where,
      std::string("no preset ") + (as_long.empty() ? "has as many columns" : "fits the values") +
        ": the columns keep their names (Preset AsNamed), and no lines are drawn. To draw them, "
        "name the particles in ColumnMap, as in id1=2 id2=3, or the ends, x1 y1 z1 x2 y2 z2, or "
        "write the keywords of the compute there, as in pos id force" });
    return name_columns(columns);
  }
  const LocalPreset& found = *fitting[0];
  if (as_long.size() > 1 &&
    !are_forces(found, columns_for(found, columns, false), columns.size(), sample))
  {
    const bool force = found.columns.find("force") != std::string_view::npos;
    notices.push_back({ where,
      "the columns are not named: taken for the preset " + describe(found) +
        ", which fits the values; set Preset to it if that is right, otherwise name the columns in "
        "ColumnMap" +
        (force ? ", such as torque, not force" : "") });
  }
  return name_columns(columns, found);
}
}
