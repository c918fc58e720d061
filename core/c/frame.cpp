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
#include <cstring>
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

/// The corners of the box; see granular_frame_header.
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

}

granular_frame_header header_of(const granular_frame& frame)
{
  const FrameHeader& from = frame.table.header;
  granular_frame_header made = {};
  made.timestep = from.timestep;
  made.has_time = from.time ? 1 : 0;
  made.time = from.time ? *from.time : frame.time;
  made.rows = frame.table.rows;
  made.has_box = from.has_box ? 1 : 0;
  made.box = box_of(from);
  made.coordinates = static_cast<granular_coordinates>(frame.table.coordinates);
  std::copy_n(frame.origin.begin(), 3, made.origin);
  made.label = from.label.c_str();
  made.units = from.units.c_str();
  made.columns = frame.column_text.c_str();
  made.digits = from.digits.data();
  made.digit_count = from.digits.size();
  made.dialect = !from.dialect ? "" : *from.dialect == Dialect::Lammps ? "LAMMPS" : "LIGGGHTS";
  made.arrays = frame.arrays.size();
  made.row_label = from.counted.c_str();
  const ShapeSizes sizes = find_shape_sizes(frame.table.schema, from.dialect == Dialect::Lammps);
  made.shape_sizes = sizes == ShapeSizes::None ? ""
    : sizes == ShapeSizes::HalfAxes            ? "half axes"
                                               : "diameters";
  made.groups = frame.group_list.data();
  made.group_count = frame.group_list.size();
  made.type_names = frame.type_names.data();
  made.type_name_count = frame.type_names.size();
  made.box_form = from.box.general ? 2 : from.box.tilted ? 1 : 0;
  fill_corners(frame, made.box_corners);
  return made;
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

void repeat_rows(Table& table)
{
  const std::vector<std::int64_t>& rows = table.lines.rows;
  const auto repeat = [&](Block& block)
  {
    const std::size_t bytes = block.bytes() / static_cast<std::size_t>(table.rows);
    Block made(rows.size() * bytes, block.pool());
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      std::memcpy(static_cast<char*>(made.data()) + i * bytes,
        static_cast<const char*>(block.data()) + static_cast<std::size_t>(rows[i]) * bytes, bytes);
    }
    block = std::move(made);
  };
  if (!rows.empty())
  {
    std::ranges::for_each(table.arrays, repeat, &TableArray::block);
    repeat(table.lines.lengths);
    table.rows = table.lines.count;
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

void expect_values(const FrameArray& array)
{
  if (array.values->data() == nullptr)
  {
    throw ArgumentError(
      "array '" + std::string(array.name) + "': expected data, got one whose memory was taken");
  }
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
    arrays.push_back({ granular_c::ends_name, ValueType::Float64, 6, &table.lines.points,
      find_known("x1", known) });
    length_name = free_name(
      "length", [&](const std::string& name) { return table.schema.find_array(name) >= 0; });
    arrays.push_back({ length_name.c_str(), ValueType::Float64, 1, &table.lines.lengths,
      find_known("length", known) });
  }
  if (split && table.has_lines)
  {
    const std::vector<std::int64_t>& rows = table.lines.rows;
    const auto count = static_cast<std::size_t>(table.lines.count);
    row_numbers = Block(count * sizeof(std::int64_t), table.lines.points.pool());
    row_parts = Block(count * sizeof(std::int32_t), table.lines.points.pool());
    auto* const numbers = static_cast<std::int64_t*>(row_numbers.data());
    auto* const parts = static_cast<std::int32_t*>(row_parts.data());
    for (std::size_t line = 0; line < count; ++line)
    {
      numbers[line] =
        table.first_row + (rows.empty() ? static_cast<std::int64_t>(line) : rows[line]);
      parts[line] = line > 0 && numbers[line - 1] == numbers[line] ? parts[line - 1] + 1 : 0;
    }
    arrays.push_back({ "row", ValueType::Int64, 1, &row_numbers, nullptr });
    arrays.push_back({ "part", ValueType::Int32, 1, &row_parts, nullptr });
  }
  if (table.points.data() != nullptr)
  {
    const std::size_t values = 3 * static_cast<std::size_t>(table.rows);
    const bool single = values > 0 && table.points.bytes() == values * sizeof(float);
    arrays.push_back({ granular_c::points_name, single ? ValueType::Float32 : ValueType::Float64, 3,
      &table.points, find_known("x", known), {}, granular_c::bounds_of(table.points_range) });
  }
  for (TableArray& array : table.arrays)
  {
    arrays.push_back({ array.info.name.c_str(), array.info.type, array.info.components(),
      &array.block, find_known(array.info.name, known), table.schema.text(array.info),
      granular_c::bounds_of(array.range) });
    std::ranges::transform(
      array.words, std::back_inserter(arrays.back().word_list), &std::string::c_str);
  }
}
