// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/write/column_plan.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

namespace granular
{
namespace
{
using Kind = ColumnSource::Kind;

/// Arrays with several columns, as far as the table has them; without values.
std::vector<ArrayView> known_arrays()
{
  std::vector<ArrayView> arrays;
  for (const KnownColumn& known : known_columns())
  {
    if (known.components > 1 && known.component == 0)
    {
      arrays.push_back({ std::string(known.array), ValueType::Float64,
        std::vector<const void*>(static_cast<std::size_t>(known.components)) });
    }
  }
  return arrays;
}

/// Returns the source of a column, if it has one. Which of two columns of the same name the array of
/// either is does not matter: they hold the same.
std::optional<ColumnSource> find_source(
  const FrameView& frame, const std::string& name, const std::optional<ValueSource>& values)
{
  const KnownColumn* known = find_known_column(name);
  const ColumnRole role = known ? known->role : ColumnRole::Other;
  ColumnSource source{ name };
  source.whole = known && (known->type == ValueType::Int32 || known->type == ValueType::Int64);
  if (is_position(role))
  {
    source.kind = Kind::Coordinate;
    source.role = role;
    source.axis = known->component;
    source.own = values && values->type != ValueType::Text;
    source.values = source.own ? *values : ValueSource{};
    return frame.points || frame.rows == 0 ? std::optional(source) : std::nullopt;
  }
  if (role == ColumnRole::Image)
  {
    source.kind = Kind::Image;
    source.axis = known->component;
    return source;
  }
  source.role = role == ColumnRole::Id ? role : ColumnRole::Other;
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
  const bool moved = frame.point_origin != Vector3{} ||
    (frame.points && is_integer(frame.points->type)); // coordinates are real numbers
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

/// Texts that a binary dump cannot hold.
bool is_lost(
  const std::string& name, const std::optional<ValueSource>& values, bool binary) noexcept
{
  return binary && values && values->type == ValueType::Text && name != "element";
}

/// A text has no place in a binary file; the element is the type there.
void replace_text(ColumnSource& column, const FrameView& frame)
{
  if (column.kind != Kind::Array || column.values.type != ValueType::Text)
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

std::vector<std::string> ColumnPlan::names() const
{
  std::vector<std::string> names(columns.size());
  std::ranges::transform(columns, names.begin(), &ColumnSource::name);
  return names;
}

bool is_blank_frame(const FrameView& frame) noexcept
{
  return frame.rows == 0 && frame.arrays.empty();
}

void fail_missing(const FrameView& frame, const std::string& name)
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

std::vector<std::string> kept_columns(
  const FrameView& frame, const std::function<bool(std::size_t column)>& is_there, Notices& notices)
{
  std::vector<std::string> names;
  std::string left_out;
  for (std::size_t i = 0; i < frame.columns.size(); ++i)
  {
    if (is_there(i))
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
  return names;
}

std::vector<std::string> default_columns(const FrameView& frame, Notices& notices, bool binary)
{
  std::string without;
  const ArraysByName arrays(frame.arrays);
  const std::vector<std::optional<ValueSource>> values = find_all_values(arrays, frame.columns);
  const auto is_there = [&](std::size_t i)
  {
    const std::string& name = frame.columns[i];
    return find_source(frame, name, values[i]) && !is_lost(name, values[i], binary);
  };
  std::vector<std::string> names = kept_columns(frame, is_there, notices);
  if (frame.columns.empty())
  {
    names = { "id", "type", "x", "y", "z" };
  }
  std::set<std::string> taken(names.begin(), names.end());
  const auto add = [&](const std::string& name)
  {
    if (taken.insert(name).second)
    {
      names.push_back(name);
    }
  };
  const ColumnSchema input(frame.columns);
  std::map<std::string_view, int> known; // also c_a_2, and the radius of a diameter
  for (const ArrayInfo& array : input.arrays())
  {
    known.emplace(array.name, array.components());
  }
  for (const ArrayView& array : frame.arrays)
  {
    const auto of_input = known.find(array.name);
    if (of_input == known.end() || of_input->second != array.size())
    {
      const std::vector<std::string> columns = columns_of(array, frame.columns);
      const ValueSource values_of_it = component_of(array, 0);
      const bool other = arrays.find(as_word(array.name), array.size()) != &array;
      if (other || is_lost(array.name, values_of_it, binary))
      {
        without += " " + array.name;
        continue;
      }
      std::for_each(columns.begin(), columns.end(), add);
    }
  }
  if (!without.empty())
  {
    notices.push_back({ {}, "arrays without a column of their own are left out:" + without });
  }
  return names;
}

std::vector<std::string> expand_columns(
  const std::vector<std::string>& names, const FrameView& frame)
{
  std::vector<std::string> columns;
  const std::vector<ArrayView> candidates = is_blank_frame(frame) ? known_arrays() : frame.arrays;
  const ArraysByName arrays(candidates);
  for (const std::string& name : names)
  {
    const ArrayView* const array = arrays.find_longer(name, 2);
    if (!array || arrays.find(name, 1))
    {
      columns.push_back(name);
      continue;
    }
    const std::vector<std::string> parts = columns_of(*array, frame.columns);
    columns.insert(columns.end(), parts.begin(), parts.end());
  }
  return columns;
}

ColumnPlan plan_columns(
  const std::vector<std::string>& names, const FrameView& frame, bool binary, Notices& notices)
{
  ColumnPlan plan;
  plan.binary = binary;
  const ArraysByName arrays(frame.arrays);
  const std::vector<std::optional<ValueSource>> values = find_all_values(arrays, names);
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
