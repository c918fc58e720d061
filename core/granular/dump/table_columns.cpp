// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/table_columns.h"

#include <algorithm>

namespace granular
{
namespace
{
bool contains(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What the columns of an array are called.
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

/// The first array that has such a column, the very names before those with blanks.
std::optional<ValueSource> find_column(const FrameView& frame, const std::string& name)
{
  if (const ArrayView* array = find_array(frame, name, 1))
  {
    return component_of(*array, 0);
  }
  for (const ArrayView& array : frame.arrays)
  {
    const std::vector<std::string> names = names_of(array);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end())
    {
      return component_of(array, static_cast<int>(found - names.begin()));
    }
  }
  return {};
}
}

std::vector<std::string> default_table_columns(const FrameView& frame, Notices& notices)
{
  std::vector<std::string> names;
  std::string left_out;
  for (const std::string& name : frame.columns)
  {
    if (find_column(frame, name) || is_blank_frame(frame))
    {
      names.push_back(name);
    }
    else
    {
      left_out += " " + name;
    }
  }
  if (!left_out.empty())
  {
    Notice notice;
    notice.text = "columns of the input without an array are left out:" + left_out;
    notices.push_back(notice);
  }
  for (const ArrayView& array : frame.arrays)
  {
    for (const std::string& name : names_of(array))
    {
      if (!contains(names, name))
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
  for (const std::string& name : names)
  {
    const auto array = std::find_if(frame.arrays.begin(), frame.arrays.end(),
      [&](const ArrayView& candidate) { return as_word(candidate.name) == name; });
    const std::vector<std::string> parts = array == frame.arrays.end() || find_column(frame, name)
      ? std::vector<std::string>{ name }
      : names_of(*array);
    columns.insert(columns.end(), parts.begin(), parts.end());
  }
  return columns;
}

ColumnPlan plan_table_columns(const std::vector<std::string>& names, const FrameView& frame)
{
  ColumnPlan plan;
  for (const std::string& name : names)
  {
    const std::optional<ValueSource> values = find_column(frame, name);
    if (!values && !is_blank_frame(frame))
    {
      fail_missing(frame, name);
    }
    ColumnSource column{ name };
    column.values = values.value_or(ValueSource{});
    column.whole = name == "id1" || name == "id2";
    plan.columns.push_back(column);
  }
  return plan;
}
}
