// SPDX-License-Identifier: BSD-3-Clause
#include "frame.h"

#include "granular/common/words.h"
#include "granular/formats/local/local_reader.h"
#include "granular/lines/line_columns.h"
#include "granular/particles/column_arrays.h"
#include "granular/runs/kind.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace granular_c
{
using namespace granular;

namespace
{

void check_array(const granular_array& array, std::int64_t rows)
{
  const std::string name = text_of(array.name);
  const auto expect = [&](bool is, const std::string& what)
  {
    if (!is)
    {
      throw ArgumentError("array '" + name + "': expected " + what);
    }
  };
  expect(!name.empty(), "a name");
  expect(array.type >= GRANULAR_INT8 && array.type <= GRANULAR_TEXT, "a type of granular_type");
  expect(array.components >= 1, "at least one component");
  expect(array.rows == 0 || array.rows >= rows,
    "at least " + std::to_string(rows) + " rows, got " + std::to_string(array.rows));
  const auto value = static_cast<std::int64_t>(size_of(static_cast<ValueType>(array.type)));
  expect(rows <= std::numeric_limits<std::int64_t>::max() / value / array.components,
    "rows that can be in memory, got " + std::to_string(rows));
  expect(array.data != nullptr || rows == 0, "data, got null");
  expect(reinterpret_cast<std::uintptr_t>(array.data) % static_cast<std::uintptr_t>(value) == 0,
    "data at a multiple of " + std::to_string(value) + " bytes");
  expect(
    array.type != GRANULAR_TEXT || (array.words != nullptr && array.components == 1) || rows == 0,
    "words and one component for text");
  expect(name != points_name || array.components == 3,
    "three components, got " + std::to_string(array.components));
  expect(name != ends_name || (array.components == 6 && array.type == GRANULAR_FLOAT64),
    "six components of doubles");
}

/// The bounds of each component, and of vectors those of their lengths; empty if they are not known.
std::vector<double> bounds_of(const ValueRange& range)
{
  std::vector<double> bounds;
  const auto add = [&](const ValueRange::Bounds& each)
  { bounds.insert(bounds.end(), each.begin(), each.end()); };
  if (range.known())
  {
    std::ranges::for_each(range.components(), add);
  }
  if (bounds.size() > 2)
  {
    add({ std::sqrt(range.squares()[0]), std::sqrt(range.squares()[1]) });
  }
  return bounds;
}

/// Expects that no value is lost because another array, or the points, have a column of the same name.
void expect_own_columns(const FrameView& view, RowKind kind)
{
  std::map<std::string, std::string> taken; // the array of each column
  for (const ArrayView& array : view.arrays)
  {
    std::vector<std::string> names = kind == RowKind::Particles ? columns_of(array) : array.columns;
    for (int i = static_cast<int>(names.size()) + 1; i <= array.size(); ++i)
    {
      names.push_back(array.size() == 1 ? array.name : array.name + "[" + std::to_string(i) + "]");
    }
    for (const std::string& name : names)
    {
      const KnownColumn* const known = find_known_column(name);
      if (view.points && known != nullptr && is_position(known->role))
      {
        throw ArgumentError("array '" + array.name +
          "': expected no coordinates beside 'points', from which they are made, got '" + name +
          "'");
      }
      const auto [other, fresh] = taken.try_emplace(name, array.name);
      if (!fresh)
      {
        throw ArgumentError("array '" + array.name + "': expected columns of its own, got '" +
          name + "', which array '" + other->second + "' has, too");
      }
    }
  }
}

/// The ends of lines as arrays position1 and position2, which local data are written from.
void add_ends(FrameView& view, const ArrayView& ends)
{
  for (std::size_t end = 0; end < 2; ++end)
  {
    const char* const name = end == 0 ? "position1" : "position2";
    if (view.find(name) != nullptr) // as the file has them
    {
      continue;
    }
    ArrayView one{ name, ends.type,
      { ends.components.begin() + static_cast<std::ptrdiff_t>(3 * end),
        ends.components.begin() + static_cast<std::ptrdiff_t>(3 * end + 3) },
      ends.step };
    view.arrays.push_back(std::move(one));
  }
}

/// Returns the columns of the file that were read: a writer would make up the others.
std::vector<std::string> columns_read(const Table& rows)
{
  std::set<int> read;
  const auto add = [&](const ArrayInfo& array)
  {
    std::ranges::copy_if(
      array.columns, std::inserter(read, read.end()), [](int column) { return column >= 0; });
  };
  std::ranges::for_each(rows.arrays, add, &TableArray::info);
  for (const ArrayInfo& array : rows.schema.arrays())
  {
    if (array.position_form && rows.points.data() != nullptr)
    {
      add(array);
    }
  }
  std::vector<std::string> columns;
  for (const int column : read)
  {
    columns.push_back(rows.schema.columns()[static_cast<std::size_t>(column)].name);
  }
  return columns;
}
}

void fill_corners(const granular_frame& frame, double (&corners)[24])
{
  for (int corner = 0; corner < 8; ++corner)
  {
    const int ends[] = { corner & 1, corner >> 1 & 1, corner >> 2 };
    const Vector3 place = frame.table.header.box.corner(ends[0], ends[1], ends[2], frame.origin);
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      corners[3 * static_cast<std::size_t>(corner) + axis] =
        frame.table.coordinates == Coordinates::Scaled ? ends[axis] - frame.origin[axis]
                                                       : place[axis];
    }
  }
}

std::vector<RegularGrid> find_grids(const granular_frame& frame, Notices& notices)
{
  const auto* const points = static_cast<const double*>(frame.table.points.data());
  if (frame.kind != RowKind::Cells || (points == nullptr && frame.table.rows > 0))
  {
    throw ArgumentError("expected cells with their points, got another frame");
  }
  EulerFrame cells;
  cells.cells = frame.table.rows;
  cells.centres.assign(points, points + 3 * frame.table.rows);
  try
  {
    return find_regular_grids(cells, notices);
  }
  catch (const UnsupportedError& error)
  {
    throw UnsupportedError(error.text(), frame.where);
  }
}

const FrameArray& find_array(const granular_frame& frame, std::string_view name)
{
  const auto found = std::ranges::find(frame.arrays, name, &FrameArray::name);
  if (found == frame.arrays.end())
  {
    throw ArgumentError("expected an array of " +
      join_words(frame.arrays, ", ", &FrameArray::name) + ", got '" + std::string(name) + "'");
  }
  return *found;
}

Box make_box(const granular_box& box)
{
  std::array<Vector3, 3> edges;
  for (std::size_t i = 0; i < 9; ++i)
  {
    edges[i / 3][i % 3] = box.vectors[i];
  }
  const double* const b = box.bounds;
  const Vector3 lo = { b[0], b[2], b[4] };
  const Vector3 hi = { b[1], b[3], b[5] };
  const bool tilted = b[6] != 0 || b[7] != 0 || b[8] != 0;
  Box made = box.has_bounds == 0
    ? Box::from_edges({ box.origin[0], box.origin[1], box.origin[2] }, edges)
    : tilted ? Box::from_tilted_bounds(lo, hi, b[6], b[7], b[8])
             : Box::from_bounds(lo, hi);
  made.boundary = text_of(box.boundary);
  return made;
}

granular_box box_of(const FrameHeader& header)
{
  granular_box made = {};
  const Vector3 origin = values_of(header.box.origin);
  std::ranges::copy(origin, made.origin);
  for (std::size_t i = 0; i < 3; ++i)
  {
    std::ranges::copy(values_of(header.box.vectors[i]), made.vectors + 3 * i);
  }
  if (!header.box.general)
  {
    const BoxBounds bounds = header.box.bounds();
    const double numbers[] = { bounds.lo[0], bounds.hi[0], bounds.lo[1], bounds.hi[1], bounds.lo[2],
      bounds.hi[2], bounds.xy, bounds.xz, bounds.yz };
    std::ranges::copy(numbers, made.bounds);
    made.has_bounds = 1;
    const Box again = make_box(made);
    const bool same = values_of(again.origin) == origin &&
      std::ranges::equal(again.vectors, header.box.vectors, {}, values_of, values_of);
    made.has_bounds = same || !header.box.tilted ? 1 : 0; // around a tilted box they may be rounded
  }
  made.boundary = header.box.boundary.c_str();
  return made;
}

WriteView::WriteView(const granular_frame& frame)
{
  view.header = frame.table.header;
  view.has_box = frame.table.header.has_box;
  view.rows = frame.table.rows;
  view.coordinates = frame.table.coordinates;
  view.point_origin = frame.origin;
  view.columns = columns_read(frame.table);
  const void* const made[] = { frame.table.lines.lengths.data(), frame.row_numbers.data(),
    frame.row_parts.data() };
  for (const FrameArray& array : frame.arrays)
  {
    if (array.data != nullptr && std::ranges::find(made, array.data) != std::end(made))
    {
      continue; // of lines that are drawn, not of the file
    }
    this->add(array.name, array.type, array.components, array.data, array.word_list);
  }
  this->finish(frame.kind);
}

WriteView::WriteView(const granular_content& content, RowKind kind)
{
  if (content.rows < 0 || (content.arrays == nullptr && content.array_count > 0))
  {
    throw ArgumentError(content.rows < 0
        ? "expected at least 0 rows, got " + std::to_string(content.rows)
        : "expected arrays, got null");
  }
  view.header.timestep = content.timestep;
  if (content.has_time != 0)
  {
    view.header.time = content.time;
  }
  view.header.units = text_of(content.units);
  view.has_box = content.box != nullptr;
  if (content.box != nullptr)
  {
    view.header.box = make_box(*content.box);
  }
  view.rows = content.rows;
  if (content.header != nullptr)
  {
    this->take_header(*content.header);
  }
  for (std::size_t i = 0; i < content.array_count; ++i)
  {
    const granular_array& array = content.arrays[i];
    check_array(array, content.rows);
    this->add(array.name, static_cast<ValueType>(array.type), array.components, array.data,
      { array.words, array.word_count });
  }
  if (kind == RowKind::Particles && content.rows > 0 && !view.points)
  {
    throw ArgumentError("expected an array 'points' with the positions of the particles, got none");
  }
  if (ends_ && (view.find("position1") != nullptr || view.find("position2") != nullptr))
  {
    throw ArgumentError("expected 'ends', or 'position1' and 'position2', got both");
  }
  this->finish(kind);
  if (content.header == nullptr && (kind == RowKind::Particles || kind == RowKind::Lines))
  {
    expect_own_columns(view, kind);
  }
}

void WriteView::take_header(const granular_frame_header& header)
{
  const std::string columns = text_of(header.columns);
  for (const std::string_view word : split_words(columns))
  {
    view.columns.emplace_back(word);
  }
  if (header.digits != nullptr && header.digit_count == view.columns.size())
  {
    view.header.digits.assign(header.digits, header.digits + header.digit_count);
  }
  const std::string dialect = text_of(header.dialect);
  if (!dialect.empty())
  {
    view.header.dialect = dialect == "LAMMPS" ? Dialect::Lammps : Dialect::Liggghts;
  }
  view.header.label = text_of(header.label);
  if (!text_of(header.row_label).empty())
  {
    view.header.counted = header.row_label;
  }
  if (header.coordinates < GRANULAR_ABSOLUTE || header.coordinates > GRANULAR_SCALED)
  {
    throw ArgumentError("expected coordinates of granular_coordinates in the header, got " +
      std::to_string(header.coordinates));
  }
  view.coordinates = static_cast<Coordinates>(header.coordinates);
  std::copy_n(header.origin, 3, view.point_origin.begin());
}

/// Names the columns of local data, whose ends are arrays like others.
void WriteView::finish(RowKind kind)
{
  if (kind != RowKind::Lines)
  {
    return;
  }
  if (ends_)
  {
    add_ends(view, *ends_);
  }
  std::erase_if(view.arrays,
    [&](const ArrayView& array)
    { return array.name == "length" && std::ranges::count(view.columns, array.name) == 0; });
  for (ArrayView& array : view.arrays)
  {
    array.columns = local_component_names(array.name, array.size());
    array.places = is_end_array(array.name) && array.size() == 3;
  }
}

void WriteView::add(std::string name, ValueType type, int components, const void* data,
  std::span<const char* const> words)
{
  if (type == ValueType::Text)
  {
    const auto* const indices = static_cast<const std::int32_t*>(data);
    auto texts = std::make_unique<std::vector<std::string>>();
    for (std::int64_t row = 0; row < view.rows; ++row)
    {
      const std::int32_t word = indices[row];
      if (word < 0 || static_cast<std::size_t>(word) >= words.size())
      {
        throw ArgumentError("array '" + name + "': expected indices of " +
          std::to_string(words.size()) + " words, got " + std::to_string(word));
      }
      texts->emplace_back(words[static_cast<std::size_t>(word)]);
    }
    data = texts->data();
    texts_.push_back(std::move(texts));
  }
  ArrayView array = view_rows(std::move(name), type, data, components);
  if (array.name == points_name)
  {
    view.points = std::move(array);
  }
  else if (array.name == ends_name)
  {
    ends_ = std::move(array);
  }
  else
  {
    view.arrays.push_back(std::move(array));
  }
}
}

using namespace granular;

granular_frame::granular_frame(granular_c::RowKind rows_kind, Table&& taken,
  std::span<const KnownColumn> known, bool split, const std::vector<std::string>& groups_read)
  : kind(rows_kind)
  , table(std::move(taken))
  , column_text(table.schema.text())
  , groups(groups_read)
{
  std::ranges::transform(groups, std::back_inserter(group_list), &std::string::c_str);
  std::ranges::transform(table.type_names, std::back_inserter(type_names), &std::string::c_str);
  if (table.has_lines)
  {
    arrays.push_back({ granular_c::ends_name, ValueType::Float64, 6, table.lines.points.data(),
      find_known("x1", known) });
    for (int number = 2; table.schema.find_array(length_name) >= 0; ++number)
    {
      length_name = "length_" + std::to_string(number);
    }
    arrays.push_back({ length_name.c_str(), ValueType::Float64, 1, table.lines.lengths.data(),
      find_known("length", known) });
  }
  for (std::int64_t line = 0; split && line < table.lines.count; ++line)
  {
    const std::int64_t row = table.first_row +
      (table.lines.rows.empty() ? line : table.lines.rows[static_cast<std::size_t>(line)]);
    row_parts.push_back(
      !row_numbers.empty() && row_numbers.back() == row ? row_parts.back() + 1 : 0);
    row_numbers.push_back(row);
  }
  if (split && table.has_lines)
  {
    arrays.push_back({ "row", ValueType::Int64, 1, row_numbers.data(), nullptr });
    arrays.push_back({ "part", ValueType::Int32, 1, row_parts.data(), nullptr });
  }
  if (table.points.data() != nullptr)
  {
    const std::size_t values = 3 * static_cast<std::size_t>(table.rows);
    const bool single = values > 0 && table.points.bytes() == values * sizeof(float);
    arrays.push_back({ granular_c::points_name, single ? ValueType::Float32 : ValueType::Float64, 3,
      table.points.data(), find_known("x", known), {}, granular_c::bounds_of(table.points_range) });
  }
  for (const TableArray& array : table.arrays)
  {
    arrays.push_back({ array.info.name.c_str(), array.info.type, array.info.components(),
      array.block.data(), find_known(array.info.name, known), table.schema.text(array.info),
      granular_c::bounds_of(array.range) });
    std::ranges::transform(
      array.words, std::back_inserter(arrays.back().word_list), &std::string::c_str);
  }
}
