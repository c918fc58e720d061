// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/write/column_plan.h"

#include <map>
#include <set>

namespace granular
{
namespace
{
/// Returns the names of the columns of an array.
std::vector<std::string> names_of(const ArrayView& array)
{
  if (!array.columns.empty())
  {
    return array.columns;
  }
  const std::string name = as_word(array.name);
  if (array.size() == 1)
  {
    return { name };
  }
  std::vector<std::string> names;
  for (int i = 1; i <= array.size(); ++i)
  {
    names.push_back(name + "[" + std::to_string(i) + "]");
  }
  return names;
}

/// The columns that the arrays of a frame have, by their names.
class TableColumns
{
public:
  explicit TableColumns(const FrameView& frame)
    : arrays_(frame.arrays)
  {
    for (const ArrayView& array : frame.arrays)
    {
      const std::vector<std::string> names = names_of(array);
      for (std::size_t i = 0; i < names.size(); ++i)
      {
        const auto component = static_cast<int>(i);
        ColumnSource column{ names[i] };
        column.values = component_of(array, component);
        column.role = array.places ? ColumnRole::Position : ColumnRole::Other;
        column.axis = array.places ? component : 0;
        columns_.try_emplace(names[i], column);
      }
    }
  }

  /// The first array that has such a column, the very names before those with blanks.
  std::optional<ColumnSource> find(const std::string& name) const
  {
    if (const ArrayView* array = arrays_.find(name, 1))
    {
      ColumnSource column{ name };
      column.values = component_of(*array, 0);
      return column;
    }
    const auto found = columns_.find(name);
    return found == columns_.end() ? std::nullopt : std::optional(found->second);
  }

  /// The first array that is called so, or null.
  const ArrayView* array(const std::string& name) const { return arrays_.find_longer(name, 0); }

private:
  ArraysByName arrays_;
  std::map<std::string, ColumnSource> columns_;
};
}

std::vector<std::string> default_table_columns(const FrameView& frame, Notices& notices)
{
  const TableColumns columns(frame);
  const auto is_there = [&](std::size_t i)
  { return columns.find(frame.columns[i]) || is_blank_frame(frame); };
  std::vector<std::string> names = kept_columns(frame, is_there, notices);
  std::set<std::string> taken(names.begin(), names.end());
  for (const ArrayView& array : frame.arrays)
  {
    for (const std::string& name : names_of(array))
    {
      if (taken.insert(name).second)
      {
        names.push_back(name);
      }
    }
  }
  return names;
}

std::vector<std::string> expand_table_columns(
  const std::vector<std::string>& names, const FrameView& frame)
{
  std::vector<std::string> columns;
  const TableColumns all(frame);
  for (const std::string& name : names)
  {
    const ArrayView* const array = all.array(name);
    const std::vector<std::string> parts =
      !array || all.find(name) ? std::vector<std::string>{ name } : names_of(*array);
    columns.insert(columns.end(), parts.begin(), parts.end());
  }
  return columns;
}

ColumnPlan plan_table_columns(const std::vector<std::string>& names, const FrameView& frame)
{
  check_column_count(names.size());
  ColumnPlan plan;
  const TableColumns columns(frame);
  for (const std::string& name : names)
  {
    const std::optional<ColumnSource> found = columns.find(name);
    if (!found && !is_blank_frame(frame))
    {
      fail_missing(frame, name);
    }
    ColumnSource column = found.value_or(ColumnSource{ name });
    column.whole = name == "id1" || name == "id2";
    plan.columns.push_back(column);
  }
  return plan;
}
}
