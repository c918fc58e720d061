// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/column_arrays.h"

#include "granular/base/words.h"

#include <algorithm>
#include <charconv>

namespace granular
{
namespace
{
/// "A[3]": component 2 of the array A.
std::optional<ValueSource> find_element(const FrameView& frame, std::string_view name)
{
  const std::size_t open = name.rfind('[');
  int number = 0;
  if (open == name.npos || !name.ends_with(']'))
  {
    return {};
  }
  const char* const last = name.data() + name.size() - 1;
  const auto [end, error] = std::from_chars(name.data() + open + 1, last, number);
  if (error != std::errc{} || end != last || number < 1)
  {
    return {};
  }
  for (const ArrayView& array : frame.arrays)
  {
    if (array.size() >= number && as_word(array.name) == name.substr(0, open))
    {
      return component_of(array, number - 1);
    }
  }
  return {};
}
}

std::string as_word(std::string name)
{
  std::replace_if(name.begin(), name.end(), is_blank, '_');
  return name;
}

const ArrayView* find_array(const FrameView& frame, std::string_view name, int components)
{
  const auto find = [&](const auto& is_it)
  {
    const auto found = std::find_if(frame.arrays.begin(), frame.arrays.end(),
      [&](const ArrayView& array) { return array.size() == components && is_it(array.name); });
    return found == frame.arrays.end() ? nullptr : &*found;
  };
  const ArrayView* const exact = find([&](const std::string& own) { return own == name; });
  return exact ? exact : find([&](const std::string& own) { return as_word(own) == name; });
}

ValueSource component_of(const ArrayView& array, int component, double factor)
{
  return { array.type, array.components[static_cast<std::size_t>(component)], array.step, factor };
}

std::optional<ValueSource> find_values(const FrameView& frame, std::string_view name)
{
  if (const ArrayView* array = find_array(frame, name, 1))
  {
    return component_of(*array, 0);
  }
  const KnownColumn* known = find_known_column(name);
  if (known && known->components > 1)
  {
    if (const ArrayView* array = find_array(frame, known->array, known->components))
    {
      return component_of(*array, known->component);
    }
  }
  struct Made
  {
    std::string_view name;
    std::string_view from;
    double factor;
  };
  constexpr Made made[] = { { "diameter", "radius", 2 }, { "radius", "diameter", 0.5 } };
  for (const Made& way : made)
  {
    const ArrayView* array = name == way.name ? find_array(frame, way.from, 1) : nullptr;
    if (array)
    {
      return component_of(*array, 0, way.factor);
    }
  }
  return find_element(frame, name);
}

std::vector<std::optional<ValueSource>> find_all_values(
  const FrameView& frame, const std::vector<std::string>& names)
{
  std::vector<std::optional<ValueSource>> values(names.size());
  const ColumnSchema schema(names);
  for (const ArrayInfo& info : schema.arrays())
  {
    const ArrayView* array =
      info.scale == 1 ? find_array(frame, info.name, info.components()) : nullptr;
    for (int i = 0; array && i < info.components(); ++i)
    {
      const auto column = static_cast<std::size_t>(info.columns[static_cast<std::size_t>(i)]);
      const bool alone = info.components() > 1 && find_array(frame, names[column], 1);
      values[column] = alone ? std::nullopt : std::optional(component_of(*array, i));
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    values[i] = values[i] ? values[i] : find_values(frame, names[i]);
  }
  return values;
}

std::vector<std::string> columns_of(const ArrayView& array)
{
  std::vector<std::string> names;
  for (const KnownColumn& known : known_columns())
  {
    if (known.components > 1 && known.components == array.size() && known.array == array.name)
    {
      names.emplace_back(known.name);
    }
  }
  if (names.empty() && array.size() == 1)
  {
    names.push_back(as_word(array.name));
  }
  for (int i = 1; static_cast<int>(names.size()) < array.size(); ++i)
  {
    names.push_back(as_word(array.name) + "[" + std::to_string(i) + "]");
  }
  return names;
}
}
