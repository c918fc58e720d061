// SPDX-License-Identifier: BSD-3-Clause
// Frames as writers take them.
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

WriteView::WriteView(const granular_frame& frame)
{
  view.header = frame.table.header;
  view.has_box = frame.table.header.has_box;
  view.rows = frame.table.rows;
  view.coordinates = frame.table.coordinates;
  view.point_origin = frame.origin;
  view.columns = columns_read(frame.table);
  const Block* const made[] = { &frame.table.lines.lengths, &frame.row_numbers, &frame.row_parts };
  for (const FrameArray& array : frame.arrays)
  {
    if (std::ranges::find(made, array.values) != std::end(made))
    {
      continue; // of lines that are drawn, not of the file
    }
    if (view.rows > 0)
    {
      expect_values(array);
    }
    this->add(array.name, array.type, array.components, array.values->data(), array.word_list);
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
  if (ends && (view.find("position1") != nullptr || view.find("position2") != nullptr))
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
  if (ends)
  {
    add_ends(view, *ends);
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
    ends = std::move(array);
  }
  else
  {
    view.arrays.push_back(std::move(array));
  }
}
}
