// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/column_plan.h"

#include "granular/base/words.h"

#include <algorithm>
#include <charconv>

namespace granular
{
namespace
{
using Kind = ColumnSource::Kind;

/// A name as the header of a dump can hold it: one word.
std::string as_word(std::string name)
{
  std::replace_if(name.begin(), name.end(), is_blank, '_');
  return name;
}

const ArrayView* find_array(const FrameView& frame, std::string_view name, int components)
{
  const auto found = std::find_if(frame.arrays.begin(), frame.arrays.end(),
    [&](const ArrayView& array)
    { return array.size() == components && as_word(array.name) == name; });
  return found == frame.arrays.end() ? nullptr : &*found;
}

ValueSource component_of(const ArrayView& array, int component, double factor = 1)
{
  return { array.type, array.components[static_cast<std::size_t>(component)], array.step, factor };
}

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

/// The array that columns of this name become, one of several or alone, or what it can be made from.
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

bool is_coordinate(ColumnRole role) noexcept
{
  return role == ColumnRole::Position || role == ColumnRole::ScaledPosition ||
    role == ColumnRole::UnwrappedPosition || role == ColumnRole::ScaledUnwrappedPosition;
}

bool is_unwrapped(ColumnRole role) noexcept
{
  return role == ColumnRole::UnwrappedPosition || role == ColumnRole::ScaledUnwrappedPosition;
}

/// The columns that an array becomes.
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

/// Filters may give a frame without grains no arrays: such a one can have any columns.
bool is_blank_frame(const FrameView& frame) noexcept
{
  return frame.rows == 0 && frame.arrays.empty();
}

/// Arrays with several columns, as far as the table has them; without values.
std::vector<ArrayView> known_arrays()
{
  std::vector<ArrayView> arrays;
  for (const KnownColumn& known : known_columns())
  {
    if (known.components > 1 && known.component == 0)
    {
      arrays.push_back({ std::string(known.array), ScalarType::Float64,
        std::vector<const void*>(static_cast<std::size_t>(known.components)) });
    }
  }
  return arrays;
}

/// Where a column comes from, if it comes from anywhere. Which of two columns of the same name the array of
/// either is does not matter: they hold the same.
std::optional<ColumnSource> find_source(
  const FrameView& frame, const std::string& name, const std::optional<ValueSource>& values)
{
  const KnownColumn* known = find_known_column(name);
  const ColumnRole role = known ? known->role : ColumnRole::Other;
  ColumnSource source{ name };
  source.whole = known && (known->type == ValueType::Int32 || known->type == ValueType::Int64);
  if (is_coordinate(role))
  {
    source.kind = Kind::Coordinate;
    source.role = role;
    source.axis = known->component;
    source.own = values && values->type != ScalarType::Text;
    source.values = source.own ? *values : ValueSource{};
    return frame.points || frame.rows == 0 ? std::optional(source) : std::nullopt;
  }
  if (role == ColumnRole::Image)
  {
    source.kind = Kind::Image;
    source.axis = known->component;
    return source;
  }
  if (values)
  {
    source.values = *values;
    return source;
  }
  if (role == ColumnRole::Id || name == "type")
  {
    source.kind = role == ColumnRole::Id ? Kind::RowNumber : Kind::One;
    return source;
  }
  return is_blank_frame(frame) ? std::optional(source) : std::nullopt;
}

[[noreturn]] void fail_missing(const FrameView& frame, const std::string& name)
{
  std::string names;
  for (const ArrayView& array : frame.arrays)
  {
    names += (names.empty() ? "" : ", ") + array.name;
  }
  throw Error("expected an array to make it from, got none: there are " +
      (names.empty() ? "no arrays" : names),
    { .column = name });
}

/// The arrays that columns become when they are read, and the values of each column in them.
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
      values[static_cast<std::size_t>(info.columns[static_cast<std::size_t>(i)])] =
        component_of(*array, i);
    }
  }
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    values[i] = values[i] ? values[i] : find_values(frame, names[i]);
  }
  return values;
}

/// Image counts, where a column needs them.
void plan_images(ColumnPlan& plan, const FrameView& frame, Notices& notices)
{
  const bool unwrapped = frame.coordinates == Coordinates::Unwrapped;
  const bool needed = std::any_of(plan.columns.begin(), plan.columns.end(),
    [unwrapped](const ColumnSource& column)
    {
      return column.kind == Kind::Image ||
        (column.kind == Kind::Coordinate && is_unwrapped(column.role) != unwrapped);
    });
  if (!needed)
  {
    return;
  }
  constexpr const char* names[] = { "ix", "iy", "iz" };
  bool found = false;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    plan.images[axis] = find_values(frame, names[axis]);
    found = found || plan.images[axis];
  }
  plan.wraps = !found && unwrapped && frame.points;
  if (!found && (frame.rows > 0 || !frame.arrays.empty()))
  {
    notices.push_back({ {},
      unwrapped ? "no array 'image': unwrapped points are wrapped into the box to count how often "
                  "it was crossed"
                : "no array 'image': the box is taken to have been crossed by none" });
  }
}

/// Coordinates that the points are, and image counts that are there as integers, are columns like others.
void take_as_they_are(ColumnPlan& plan, const FrameView& frame)
{
  const bool moved = frame.point_origin != Vector3{};
  const ColumnRole stored = frame.coordinates == Coordinates::Absolute ? ColumnRole::Position
    : frame.coordinates == Coordinates::Unwrapped ? ColumnRole::UnwrappedPosition
                                                  : ColumnRole::ScaledPosition;
  for (ColumnSource& column : plan.columns)
  {
    const auto axis = static_cast<std::size_t>(column.axis);
    const std::optional<ValueSource>& image = plan.images[axis];
    if (column.kind == Kind::Coordinate && !moved && !column.own && column.role == stored)
    {
      column.kind = Kind::Array;
      column.values = frame.points ? component_of(*frame.points, column.axis) : ValueSource{};
    }
    if (column.kind == Kind::Image && image && is_integer(image->type) && image->factor == 1)
    {
      column.kind = Kind::Array;
      column.values = *image;
    }
  }
}

/// A text has no place in a binary file; the element is the type there.
void replace_text(ColumnSource& column, const FrameView& frame)
{
  if (column.kind != Kind::Array || column.values.type != ScalarType::Text)
  {
    return;
  }
  if (column.name != "element")
  {
    throw UnsupportedError(
      "expected numbers for a binary dump, got texts", { .column = column.name });
  }
  const std::optional<ValueSource> types = find_values(frame, "type");
  column.kind = types ? Kind::Array : Kind::One;
  column.values = types.value_or(ValueSource{});
}
}

bool ColumnPlan::has_coordinates() const noexcept
{
  return std::any_of(columns.begin(), columns.end(),
    [](const ColumnSource& column) { return column.kind == Kind::Coordinate; });
}

std::vector<std::string> default_columns(const FrameView& frame, Notices& notices)
{
  std::vector<std::string> names;
  std::string left_out;
  const std::vector<std::optional<ValueSource>> values = find_all_values(frame, frame.columns);
  for (std::size_t i = 0; i < frame.columns.size(); ++i)
  {
    if (find_source(frame, frame.columns[i], values[i]))
    {
      names.push_back(frame.columns[i]);
    }
    else
    {
      left_out += " " + frame.columns[i];
    }
  }
  if (!left_out.empty())
  {
    notices.push_back({ {}, "columns of the input without an array are left out:" + left_out });
  }
  if (frame.columns.empty())
  {
    names = { "id", "type", "x", "y", "z" };
  }
  const auto add = [&](const std::string& name)
  {
    if (std::find(names.begin(), names.end(), name) == names.end())
    {
      names.push_back(name);
    }
  };
  const ColumnSchema input(frame.columns);
  for (const ArrayView& array : frame.arrays)
  {
    const int known = input.find_array(array.name); // also c_a_2, and the radius of a diameter
    if (known < 0 || input.arrays()[static_cast<std::size_t>(known)].components() != array.size())
    {
      const std::vector<std::string> columns = columns_of(array);
      std::for_each(columns.begin(), columns.end(), add);
    }
  }
  return names;
}

std::vector<std::string> expand_columns(
  const std::vector<std::string>& names, const FrameView& frame)
{
  std::vector<std::string> columns;
  const std::vector<ArrayView> arrays = is_blank_frame(frame) ? known_arrays() : frame.arrays;
  for (const std::string& name : names)
  {
    const auto array = std::find_if(arrays.begin(), arrays.end(),
      [&](const ArrayView& candidate)
      { return candidate.size() > 1 && as_word(candidate.name) == name; });
    if (array == arrays.end() || find_array(frame, name, 1))
    {
      columns.push_back(name);
      continue;
    }
    const std::vector<std::string> parts = columns_of(*array);
    columns.insert(columns.end(), parts.begin(), parts.end());
  }
  return columns;
}

ColumnPlan plan_columns(
  const std::vector<std::string>& names, const FrameView& frame, bool binary, Notices& notices)
{
  ColumnPlan plan;
  plan.binary = binary;
  const std::vector<std::optional<ValueSource>> values = find_all_values(frame, names);
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const std::optional<ColumnSource> source = find_source(frame, names[i], values[i]);
    if (!source)
    {
      fail_missing(frame, names[i]);
    }
    plan.columns.push_back(*source);
    const bool blank = is_blank_frame(frame);
    if (source->kind == Kind::RowNumber && !blank)
    {
      notices.push_back({ {}, "no array 'id': ids are the numbers of the rows, from 1" });
    }
    if (source->kind == Kind::One && !blank)
    {
      notices.push_back({ {}, "no array 'type': the type of all is 1" });
    }
    if (binary)
    {
      replace_text(plan.columns.back(), frame);
    }
  }
  plan_images(plan, frame, notices);
  take_as_they_are(plan, frame);
  plan.ids = find_values(frame, "id");
  if (plan.ids && !is_integer(plan.ids->type))
  {
    plan.ids.reset();
  }
  return plan;
}
}
