// SPDX-License-Identifier: BSD-3-Clause
#include "granular/columns/column.h"

#include "granular/columns/known_columns.h"
#include "granular/common/words.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace granular
{
namespace
{
/// Columns that may form one array: names of the table that share `array`, or ID[1..n], or ID[0..n].
struct Group
{
  std::string array;
  bool from_table = false;
  std::size_t components = 0;         ///< as the table says
  std::map<std::size_t, int> columns; ///< by component, or index
};

using Groups = std::map<std::string, Group>;

bool matches(std::string_view pattern, std::string_view name) noexcept
{
  return pattern.ends_with('*') ? name.starts_with(pattern.substr(0, pattern.size() - 1))
                                : pattern == name;
}

/// Splits "c_abc[2]" into "c_abc" and 2. Negative if the name is no element of a compute, fix,
/// variable or custom array.
int split_index(std::string_view name, std::string_view& base) noexcept
{
  constexpr std::string_view prefixes[] = { "c_", "f_", "v_", "i2_", "d2_" };
  const auto has_prefix = [name](std::string_view prefix) { return name.starts_with(prefix); };
  const std::size_t open = name.find('[');
  if (open == name.npos || !name.ends_with(']') ||
    std::none_of(std::begin(prefixes), std::end(prefixes), has_prefix))
  {
    return -1;
  }
  int index = 0;
  const char* const last = name.data() + name.size() - 1;
  const auto [ptr, ec] = std::from_chars(name.data() + open + 1, last, index);
  base = name.substr(0, open);
  return ec == std::errc{} && ptr == last ? index : -1;
}

ColumnInfo describe(const std::string& name, std::span<const KnownColumn> table)
{
  ColumnInfo column;
  column.name = name;
  column.open = true;
  if (const KnownColumn* known = find_known_column(name, table))
  {
    column.open = known->name.ends_with('*') && known->type == ValueType::Float64;
    column.type = known->type;
    column.role = known->role;
    column.component = known->component;
    column.known = true;
    column.may_be_words = name == "type"; // which own codes, and labels of LAMMPS, make words
  }
  return column;
}

Groups collect_groups(const std::vector<ColumnInfo>& columns, std::span<const KnownColumn> table)
{
  Groups groups;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    const KnownColumn* known = find_known_column(columns[i].name, table);
    const bool from_table = known && known->components > 1;
    std::string_view base = from_table ? known->array : std::string_view();
    const int index = from_table ? known->component : split_index(columns[i].name, base);
    if (index >= 0)
    {
      Group& group = groups[std::string(base) + (from_table ? "*" : "")];
      group.array = base;
      group.from_table = group.from_table || from_table;
      group.components = from_table ? static_cast<std::size_t>(known->components) : 0;
      // a column seen twice stays out: which of the two is meant cannot be known
      group.columns.try_emplace(static_cast<std::size_t>(index), static_cast<int>(i));
    }
  }
  return groups;
}

/// Complete, and elements ID[1..n] or ID[0..n] also at least two and in the file's order: a vector whose components
/// changed places would be wrong without anybody noticing.
bool is_array(const Group& group)
{
  const std::size_t size = group.columns.size();
  const std::size_t first = group.columns.begin()->first;
  return group.from_table
    ? size == group.components
    : size > 1 && first <= 1 && group.columns.rbegin()->first == first + size - 1 &&
      std::ranges::is_sorted(group.columns, {}, [](const auto& member) { return member.second; });
}

bool holds_texts(const Group& group, const std::vector<ColumnInfo>& columns)
{
  return std::ranges::any_of(group.columns,
    [&](const auto& member)
    { return columns[static_cast<std::size_t>(member.second)].type == ValueType::Text; });
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

/// An array of these columns, whose type and role are those of the first one listed.
ArrayInfo make_array(const std::string& name, std::vector<int> members,
  const std::vector<ColumnInfo>& columns, TakenNames& taken)
{
  const ColumnInfo& first = columns[static_cast<std::size_t>(*std::ranges::min_element(members))];
  ArrayInfo array;
  array.name = make_unique(name, taken);
  array.columns = std::move(members);
  array.type = first.type;
  array.role = first.role;
  array.position_form = is_position(first.role);
  return array;
}

std::vector<ArrayInfo> list_arrays(
  const std::vector<ColumnInfo>& columns, std::span<const KnownColumn> table)
{
  const Groups groups = collect_groups(columns, table);
  std::vector<const Group*> vector_of(columns.size());
  std::vector<std::string_view> split_from(columns.size());
  for (const auto& [key, group] : groups)
  {
    const bool vector = is_array(group);
    const bool texts = vector && holds_texts(group, columns);
    for (const auto& [component, column] : group.columns)
    {
      vector_of[static_cast<std::size_t>(column)] = vector && !texts ? &group : nullptr;
      split_from[static_cast<std::size_t>(column)] = texts ? group.array : std::string_view();
    }
  }
  std::vector<ArrayInfo> arrays;
  TakenNames taken;
  std::set<const Group*> listed; // an array stands where its first column stands
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    const Group* const vector = vector_of[i];
    if (!vector)
    {
      arrays.push_back(make_array(columns[i].name, { static_cast<int>(i) }, columns, taken));
      arrays.back().group = split_from[i];
    }
    else if (listed.insert(vector).second)
    {
      std::vector<int> members;
      std::ranges::transform(vector->columns, std::back_inserter(members),
        [](const auto& member) { return member.second; });
      arrays.push_back(make_array(vector->array, std::move(members), columns, taken));
    }
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

void check_column_count(std::size_t columns, const Where& where)
{
  if (columns > most_columns)
  {
    throw LimitError("expected at most " + std::to_string(most_columns) + " columns, got " +
        std::to_string(columns),
      where);
  }
}

ColumnSchema::ColumnSchema(
  const std::vector<std::string>& names, std::span<const KnownColumn> table, const Where& where)
  : table_(table)
{
  check_column_count(names.size(), where);
  std::set<std::pair<ColumnRole, int>> taken;
  for (const std::string& name : names)
  {
    columns_.push_back(describe(name, table));
    ColumnInfo& column = columns_.back();
    if (column.role != ColumnRole::Other && !taken.emplace(column.role, column.component).second)
    {
      column.role =
        ColumnRole::Other; // the first column has the role; a second one is just a column
    }
  }
  this->make_arrays();
}

void ColumnSchema::make_arrays()
{
  arrays_ = list_arrays(columns_, table_);
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
  const auto found = std::ranges::find(arrays_, name, &ArrayInfo::name);
  return found == arrays_.end() ? -1 : static_cast<int>(found - arrays_.begin());
}

std::vector<int> ColumnSchema::arrays_of_columns() const
{
  std::vector<int> arrays(columns_.size());
  for (std::size_t i = arrays_.size(); i-- > 0;) // the radius stands last
  {
    for (const int column : arrays_[i].columns)
    {
      arrays[static_cast<std::size_t>(column)] = static_cast<int>(i);
    }
  }
  return arrays;
}

std::string ColumnSchema::text() const
{
  return join_words(columns_, " ", &ColumnInfo::name);
}

std::string ColumnSchema::text(const ArrayInfo& array) const
{
  if (array.scale != 1 || std::ranges::any_of(array.columns, [](int column) { return column < 0; }))
  {
    return {};
  }
  return join_words(array.columns, " ",
    [this](int column) { return columns_[static_cast<std::size_t>(column)].name; });
}

void ColumnSchema::set_types(std::span<const TypeChange> changes)
{
  if (changes.empty())
  {
    return;
  }
  const std::vector<int> array_of = this->arrays_of_columns();
  std::set<int> changed;
  for (const auto& [column, type] : changes)
  {
    const int array = array_of[static_cast<std::size_t>(column)];
    if (type != ValueType::Text && changed.insert(array).second)
    {
      for (const int member : arrays_[static_cast<std::size_t>(array)].columns)
      {
        ColumnInfo& own = columns_[static_cast<std::size_t>(member)];
        own.type = type;
        own.open = own.open && type != ValueType::Float64;
      }
    }
  }
  for (const auto& [column, type] : changes)
  {
    ValueType& own = columns_[static_cast<std::size_t>(column)].type;
    own = type == ValueType::Text ? type : own;
  }
  for (ColumnInfo& column : columns_)
  {
    if (column.role == ColumnRole::Id && column.type != ValueType::Int64)
    {
      column.role = ColumnRole::Other; // nothing to sort or select by
    }
  }
  this->make_arrays();
}

void ColumnSchema::set_type(int column, ValueType type)
{
  const TypeChange change = { column, type };
  this->set_types({ &change, 1 });
}

bool ColumnSchema::operator==(const ColumnSchema& other) const
{
  return std::equal(columns_.begin(), columns_.end(), other.columns_.begin(), other.columns_.end(),
    [](const ColumnInfo& a, const ColumnInfo& b) { return a.name == b.name && a.type == b.type; });
}

ShapeSizes find_shape_sizes(const ColumnSchema& schema, bool lammps) noexcept
{
  const int shape = schema.find_array("shape");
  if (shape < 0 || schema.arrays()[static_cast<std::size_t>(shape)].components() != 3)
  {
    return ShapeSizes::None;
  }
  for (const ColumnInfo& column : schema.columns())
  {
    if (column.name == "quatw" || column.name == "block1")
    {
      return ShapeSizes::Diameters;
    }
    if (column.name == "quat1" || column.name == "blockiness1")
    {
      return ShapeSizes::HalfAxes;
    }
  }
  return lammps ? ShapeSizes::Diameters : ShapeSizes::HalfAxes;
}
}
