// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/column_arrays.h"

#include "granular/common/words.h"

#include <algorithm>
#include <charconv>

namespace granular
{
namespace
{
/// "A[3]": component 2 of the array A.
std::optional<ValueSource> find_element(const ArraysByName& arrays, std::string_view name)
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
  const ArrayView* const array = arrays.find_longer(name.substr(0, open), number);
  return array ? std::optional(component_of(*array, number - 1)) : std::nullopt;
}
}

std::string as_word(std::string name)
{
  std::replace_if(name.begin(), name.end(), is_blank, '_');
  return name;
}

ArraysByName::ArraysByName(const std::vector<ArrayView>& arrays)
{
  for (const ArrayView& array : arrays)
  {
    names_[array.name].push_back(&array);
    words_[as_word(array.name)].push_back(&array);
  }
}

const ArrayView* ArraysByName::find(std::string_view name, int components) const
{
  for (const Places* const places : { &names_, &words_ })
  {
    const auto all = places->find(name);
    if (all != places->end())
    {
      const auto found = std::ranges::find(all->second, components, &ArrayView::size);
      if (found != all->second.end())
      {
        return *found;
      }
    }
  }
  return nullptr;
}

const ArrayView* ArraysByName::find_longer(std::string_view word, int components) const
{
  const auto all = words_.find(word);
  if (all == words_.end())
  {
    return nullptr;
  }
  const auto found = std::ranges::find_if(
    all->second, [components](const ArrayView* array) { return array->size() >= components; });
  return found == all->second.end() ? nullptr : *found;
}

ValueSource component_of(const ArrayView& array, int component, double factor)
{
  return { array.type, array.components[static_cast<std::size_t>(component)], array.step, factor };
}

std::optional<ValueSource> find_values(const ArraysByName& arrays, std::string_view name)
{
  if (const ArrayView* array = arrays.find(name, 1))
  {
    return component_of(*array, 0);
  }
  const KnownColumn* known = find_known_column(name);
  if (known && known->components > 1)
  {
    if (const ArrayView* array = arrays.find(known->array, known->components))
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
    const ArrayView* array = name == way.name ? arrays.find(way.from, 1) : nullptr;
    if (array)
    {
      return component_of(*array, 0, way.factor);
    }
  }
  return find_element(arrays, name);
}

std::vector<std::optional<ValueSource>> find_all_values(
  const ArraysByName& arrays, const std::vector<std::string>& names)
{
  std::vector<std::optional<ValueSource>> values(names.size());
  const ColumnSchema schema(names);
  for (const ArrayInfo& info : schema.arrays())
  {
    const ArrayView* array = info.scale == 1 ? arrays.find(info.name, info.components()) : nullptr;
    for (int i = 0; array && i < info.components(); ++i)
    {
      const auto column = static_cast<std::size_t>(info.columns[static_cast<std::size_t>(i)]);
      const bool alone = info.components() > 1 && arrays.find(names[column], 1);
      values[column] = alone ? std::nullopt : std::optional(component_of(*array, i));
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    values[i] = values[i] ? values[i] : find_values(arrays, names[i]);
  }
  return values;
}

std::vector<std::string> columns_of(const ArrayView& array, const std::vector<std::string>& input)
{
  std::vector<std::string> names;
  std::vector<std::string> spelling;
  for (const KnownColumn& known : known_columns())
  {
    if (known.components > 1 && known.components == array.size() && known.array == array.name)
    {
      spelling.emplace_back(known.name);
      if (static_cast<int>(spelling.size()) == array.size())
      {
        const bool is_spelled = std::ranges::find(input, spelling.front()) != input.end();
        names = names.empty() || is_spelled ? spelling : names;
        spelling.clear();
      }
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
