// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/local_presets.h"

#include "granular/base/number.h"
#include "granular/base/words.h"
#include "granular/dump/point_forms.h"
#include "granular/local/local_columns.h"
#include "granular/local/minimum_image.h"

#include <algorithm>
#include <array>
#include <cmath>
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

bool is_integral(double value) noexcept
{
  return std::isfinite(value) && value == std::nearbyint(value);
}

/// What a column may hold; null: anything.
using Rule = bool (*)(double);

Rule rule_of(std::string_view name) noexcept
{
  struct Entry
  {
    std::string_view name;
    Rule rule;
  };
  static constexpr Entry rules[] = {
    { "id1", [](double value) { return is_integral(value) && value >= 1; } },
    { "id2", [](double value) { return is_integral(value) && value >= 1; } },
    { "mesh", [](double value) { return is_integral(value) && value >= 0; } },
    { "triangle", [](double value) { return is_integral(value) && value >= 0; } },
    { "btype", [](double value) { return is_integral(value) && value != 0; } },
    { "periodic", [](double value) { return value == 0 || value == 1; } },
    { "dist", [](double value) { return value >= 0; } },
  };
  const auto* const found =
    std::ranges::find_if(rules, [&](const Entry& entry) { return entry.name == name; });
  return found == std::end(rules) ? nullptr : found->rule;
}

/// The rows of a sample as a preset sees them.
class PresetRows
{
public:
  PresetRows(const LocalPreset& preset, std::span<const std::size_t> columns, std::size_t all,
    const LocalSample& sample)
    : names_(split_words(preset.columns))
    , columns_(columns)
    , all_(all)
    , sample_(sample)
  {
  }

  bool keep_rules() const;
  bool ends_differ() const;
  bool few_values() const;
  bool flags_fit() const;
  bool places_fit() const;

private:
  bool has(std::string_view name) const { return std::ranges::find(names_, name) != names_.end(); }

  double value(std::size_t row, std::string_view name) const
  {
    const auto at = static_cast<std::size_t>(std::ranges::find(names_, name) - names_.begin());
    return sample_.values[row * all_ + columns_[at]];
  }

  Vector3 place(std::size_t row, int end) const
  {
    const bool first = end == 1;
    return { this->value(row, first ? "x1" : "x2"), this->value(row, first ? "y1" : "y2"),
      this->value(row, first ? "z1" : "z2") };
  }

  std::vector<std::string_view> names_;
  std::span<const std::size_t> columns_;
  std::size_t all_;
  const LocalSample& sample_;
};

bool PresetRows::keep_rules() const
{
  for (std::size_t i = 0; i < names_.size(); ++i)
  {
    const Rule rule = rule_of(names_[i]);
    for (std::size_t row = 0; rule && row < sample_.rows; ++row)
    {
      if (!rule(sample_.values[row * all_ + columns_[i]]))
      {
        return false;
      }
    }
  }
  return true;
}

bool PresetRows::ends_differ() const
{
  if (!this->has("id1") || !this->has("id2"))
  {
    return true;
  }
  for (std::size_t row = 0; row < sample_.rows; ++row)
  {
    if (this->value(row, "id1") == this->value(row, "id2"))
    {
      return false;
    }
  }
  return true;
}

bool PresetRows::few_values() const
{
  for (const std::string_view name : { "btype", "mesh" })
  {
    if (!this->has(name) || (name == "btype" && this->has("x1")))
    {
      continue;
    }
    std::set<double> distinct;
    for (std::size_t row = 0; row < sample_.rows; ++row)
    {
      distinct.insert(this->value(row, name));
    }
    if (distinct.size() * distinct.size() > sample_.rows)
    {
      return false;
    }
  }
  return true;
}

bool PresetRows::flags_fit() const
{
  if (!this->has("periodic") || !this->has("x1") || sample_.box.tilted)
  {
    return true;
  }
  for (std::size_t row = 0; row < sample_.rows; ++row)
  {
    const Vector3 first = this->place(row, 1);
    const Vector3 second = this->place(row, 2);
    bool far = false;
    bool near_half = false; // either may be right
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double half = std::abs(sample_.box.vectors[axis][axis].value()) / 2;
      const double distance = std::abs(second[axis] - first[axis]);
      far = far || (is_periodic(sample_.box, axis) && distance > half);
      near_half = near_half || std::abs(distance - half) < 1e-3 * half;
    }
    if (!near_half && far != (this->value(row, "periodic") == 1))
    {
      return false;
    }
  }
  return true;
}

/// Places are printed with six digits, or more.
bool PresetRows::places_fit() const
{
  constexpr double digits = 2e-5;
  const MinimumImage images(sample_.box);
  std::map<double, Vector3> places;
  for (std::size_t row = 0; this->has("x1") && row < sample_.rows; ++row)
  {
    for (const int end : { 1, 2 })
    {
      const std::string_view id = end == 1 ? "id1" : "id2";
      if (!this->has(id))
      {
        continue;
      }
      const Vector3 here = this->place(row, end);
      const auto [known, is_new] = places.try_emplace(this->value(row, id), here);
      Vector3 apart = {};
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        apart[axis] = here[axis] - known->second[axis];
      }
      const Vector3 shift = images.shift(images.find(apart));
      for (std::size_t axis = 0; axis < 3 && !is_new; ++axis)
      {
        const double most = std::max(std::abs(here[axis]), std::abs(known->second[axis]));
        if (!(std::abs(apart[axis] + shift[axis]) <= digits * (most + std::abs(shift[axis]))))
        {
          return false;
        }
      }
    }
  }
  return true;
}

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

void check_distinct(const std::vector<std::string>& names)
{
  std::set<std::string_view> seen;
  for (const std::string& name : names)
  {
    if (!seen.insert(name).second)
    {
      throw FormatError("expected each name once in the column map, got '" + name + "' twice");
    }
  }
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
  check_distinct(all);
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const auto found = given.find(i);
    if (found != given.end())
    {
      names[i] = found->second;
    }
    else if (std::ranges::find(all, names[i]) != all.end())
    {
      names[i] = columns[i]; // its name is another column's now
    }
  }
  return names;
}
}

std::span<const LocalPreset> local_presets() noexcept
{
  return presets;
}

bool fits(const LocalPreset& preset, std::span<const std::size_t> columns, std::size_t all,
  const LocalSample& sample)
{
  const PresetRows rows(preset, columns, all, sample);
  return rows.keep_rules() && rows.ends_differ() && rows.few_values() && rows.flags_fit() &&
    rows.places_fit();
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
    return name_by_pairs(columns, words);
  }
  const std::vector<std::string> names = expand_keywords(words, columns.size());
  if (names.size() != columns.size())
  {
    throw FormatError("expected a name for each of " + std::to_string(columns.size()) +
      " columns in the column map, got " + std::to_string(names.size()) + ": " + join_words(names) +
      "; the columns are " + join_words(columns));
  }
  check_distinct(names);
  return names;
}

std::vector<std::string> find_columns(const std::vector<std::string>& columns,
  const LocalSample& sample, const Where& where, Notices& notices)
{
  const std::vector<std::string> by_name = name_columns(columns);
  const ColumnSchema schema = make_local_schema(by_name);
  if (sample.rows == 0 || has_ids(schema) || has_ends(schema))
  {
    return by_name;
  }
  std::vector<const LocalPreset*> as_long;
  std::vector<const LocalPreset*> fitting;
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
    }
  }
  if (fitting.size() != 1)
  {
    const std::vector<const LocalPreset*>& listed = fitting.empty() ? as_long : fitting;
    std::string text = "expected columns whose names say what they hold, got " +
      join_words(columns) + "; " +
      (listed.empty()       ? "no preset has as many"
          : fitting.empty() ? "no preset fits the values, of as many columns are"
                            : "several presets fit the values:");
    for (const LocalPreset* preset : listed)
    {
      text += " " + describe(*preset);
    }
    throw FormatError(text + "; set Preset or ColumnMap", where);
  }
  if (as_long.size() > 1)
  {
    std::vector<std::string_view> others;
    for (const LocalPreset* preset : as_long)
    {
      if (preset != fitting[0])
      {
        others.push_back(preset->name);
      }
    }
    notices.push_back({ where,
      "the columns are not named: taken for the preset " + describe(*fitting[0]) +
        ", which fits the values, and not for " + join_words(others) });
  }
  return name_columns(columns, *fitting[0]);
}
}
