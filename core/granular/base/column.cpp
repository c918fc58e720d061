// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/column.h"

#include "granular/base/known_columns.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

namespace granular
{
namespace
{
/// Columns that may form one array: names of the table that share `array`, or ID[1..n].
struct Group
{
  std::string array;
  std::vector<int> columns; ///< by component; -1: not seen
};

using Groups = std::map<std::string, Group>;

bool matches(std::string_view pattern, std::string_view name) noexcept
{
  return pattern.ends_with('*') ? name.starts_with(pattern.substr(0, pattern.size() - 1))
                                : pattern == name;
}

/// Splits "c_abc[2]" into "c_abc" and 2. Zero if the name is no element of a compute, fix,
/// variable or custom array.
int split_index(std::string_view name, std::string_view& base) noexcept
{
  constexpr std::string_view prefixes[] = { "c_", "f_", "v_", "i2_", "d2_" };
  const auto has_prefix = [name](std::string_view prefix) { return name.starts_with(prefix); };
  const std::size_t open = name.find('[');
  if (open == name.npos || !name.ends_with(']') ||
    std::none_of(std::begin(prefixes), std::end(prefixes), has_prefix))
  {
    return 0;
  }
  int index = 0;
  const char* const last = name.data() + name.size() - 1;
  const auto [ptr, ec] = std::from_chars(name.data() + open + 1, last, index);
  base = name.substr(0, open);
  return ec == std::errc{} && ptr == last && index >= 1 ? index : 0;
}

ColumnInfo describe(const std::string& name, std::span<const KnownColumn> table)
{
  ColumnInfo column;
  column.name = name;
  if (const KnownColumn* known = find_known_column(name, table))
  {
    column.type = known->type;
    column.role = known->role;
    column.component = known->component;
    column.known = true;
  }
  return column;
}

/// A column seen twice stays out of the group: which of the two is meant cannot be known.
void join(Group& group, std::string_view array, std::size_t component, int column)
{
  group.array = array;
  group.columns.resize(std::max(group.columns.size(), component + 1), -1);
  int& place = group.columns[component];
  place = place < 0 ? column : place;
}

Groups collect_groups(const std::vector<ColumnInfo>& columns, std::span<const KnownColumn> table)
{
  Groups groups;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    const KnownColumn* known = find_known_column(columns[i].name, table);
    std::string_view base;
    if (known && known->components > 1)
    {
      Group& group = groups[std::string(known->array) + "*"];
      group.columns.resize(static_cast<std::size_t>(known->components), -1);
      join(group, known->array, static_cast<std::size_t>(known->component), static_cast<int>(i));
    }
    else if (const int index = split_index(columns[i].name, base); index > 0)
    {
      // an index that leaves a gap for certain leaves one of bounded size
      const std::size_t component = std::min(static_cast<std::size_t>(index - 1), columns.size());
      join(groups[std::string(base)], base, component, static_cast<int>(i));
    }
  }
  return groups;
}

/// Complete, and ID[1..n] also with n >= 2 and in the file's order: a vector whose components
/// changed places would be wrong without anybody noticing.
bool is_array(const std::string& key, const Group& group)
{
  const bool complete =
    std::find(group.columns.begin(), group.columns.end(), -1) == group.columns.end();
  const bool from_table = key.ends_with('*');
  return complete && group.columns.size() > 1 &&
    (from_table || std::is_sorted(group.columns.begin(), group.columns.end()));
}

/// Names that are taken, and the number that the next copy of each may get.
using TakenNames = std::map<std::string, int>;

std::string make_unique(const std::string& name, TakenNames& taken)
{
  const auto [place, fresh] = taken.try_emplace(name, 2);
  std::string unique = name;
  while (!fresh && (unique == name || !taken.try_emplace(unique, 2).second))
  {
    unique = name + "_" + std::to_string(place->second++);
  }
  return unique;
}

bool is_position(ColumnRole role) noexcept
{
  return role == ColumnRole::Position || role == ColumnRole::ScaledPosition ||
    role == ColumnRole::UnwrappedPosition || role == ColumnRole::ScaledUnwrappedPosition;
}

std::vector<ArrayInfo> make_arrays(
  const std::vector<ColumnInfo>& columns, std::span<const KnownColumn> table)
{
  std::map<int, const Group*> first_columns; // the array stands where its first column stands
  std::set<int> grouped;
  const Groups groups = collect_groups(columns, table);
  for (const auto& [key, group] : groups)
  {
    if (is_array(key, group))
    {
      first_columns[*std::min_element(group.columns.begin(), group.columns.end())] = &group;
      grouped.insert(group.columns.begin(), group.columns.end());
    }
  }
  std::vector<ArrayInfo> arrays;
  TakenNames taken;
  for (int i = 0; i < static_cast<int>(columns.size()); ++i)
  {
    const ColumnInfo& column = columns[static_cast<std::size_t>(i)];
    const auto group = first_columns.find(i);
    if (group == first_columns.end() && grouped.contains(i))
    {
      continue;
    }
    ArrayInfo array;
    array.name =
      make_unique(group == first_columns.end() ? column.name : group->second->array, taken);
    array.columns = group == first_columns.end() ? std::vector<int>{ i } : group->second->columns;
    array.type = column.type;
    array.role = column.role;
    array.position_form = is_position(column.role);
    arrays.push_back(std::move(array));
  }
  return arrays;
}

void add_radius(const ColumnSchema& schema, std::vector<ArrayInfo>& arrays)
{
  const int diameter = schema.find(ColumnRole::Diameter);
  if (diameter >= 0 && schema.find(ColumnRole::Radius) < 0)
  {
    ArrayInfo radius;
    radius.name = "radius";
    radius.role = ColumnRole::Radius;
    radius.columns = { diameter };
    radius.scale = 0.5;
    arrays.push_back(std::move(radius));
  }
}
}

std::size_t size_of(ValueType type) noexcept
{
  return type == ValueType::Int32 || type == ValueType::Text ? sizeof(std::int32_t)
                                                             : sizeof(double);
}

std::span<const KnownColumn> known_columns() noexcept
{
  return known_column_table;
}

const KnownColumn* find_known_column(
  std::string_view name, std::span<const KnownColumn> table) noexcept
{
  const auto found = std::ranges::find_if(
    table, [name](const KnownColumn& column) { return matches(column.name, name); });
  return found == table.end() ? nullptr : &*found;
}

ColumnSchema::ColumnSchema(
  const std::vector<std::string>& names, std::span<const KnownColumn> table)
{
  for (const std::string& name : names)
  {
    columns_.push_back(describe(name, table));
    ColumnInfo& column = columns_.back();
    if (this->find(column.role, column.component) < static_cast<int>(columns_.size()) - 1)
    {
      column.role =
        ColumnRole::Other; // the first column has the role; a second one is just a column
    }
  }
  arrays_ = make_arrays(columns_, table);
  add_radius(*this, arrays_);
}

int ColumnSchema::find(ColumnRole role, int component) const noexcept
{
  const auto found = std::find_if(columns_.begin(), columns_.end(),
    [=](const ColumnInfo& column) { return column.role == role && column.component == component; });
  return found == columns_.end() ? -1 : static_cast<int>(found - columns_.begin());
}

int ColumnSchema::find_array(std::string_view name) const noexcept
{
  const auto found = std::find_if(
    arrays_.begin(), arrays_.end(), [name](const ArrayInfo& array) { return array.name == name; });
  return found == arrays_.end() ? -1 : static_cast<int>(found - arrays_.begin());
}

std::string ColumnSchema::text() const
{
  std::string text;
  for (const ColumnInfo& column : columns_)
  {
    text += (text.empty() ? "" : " ") + column.name;
  }
  return text;
}

void ColumnSchema::set_type(int column, ValueType type)
{
  ColumnInfo& changed = columns_[static_cast<std::size_t>(column)];
  changed.type = type;
  if (changed.role == ColumnRole::Id && type != ValueType::Int64)
  {
    changed.role = ColumnRole::Other; // nothing to sort or select by
  }
  for (ArrayInfo& array : arrays_)
  {
    if (std::find(array.columns.begin(), array.columns.end(), column) != array.columns.end())
    {
      array.type = type;
      array.role = array.role == ColumnRole::Id ? changed.role : array.role;
      for (const int member : array.columns)
      {
        columns_[static_cast<std::size_t>(member)].type = type;
      }
    }
  }
}

bool ColumnSchema::operator==(const ColumnSchema& other) const
{
  return std::equal(columns_.begin(), columns_.end(), other.columns_.begin(), other.columns_.end(),
    [](const ColumnInfo& a, const ColumnInfo& b) { return a.name == b.name && a.type == b.type; });
}
}
