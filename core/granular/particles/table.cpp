// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/table.h"

#include <algorithm>
#include <utility>

namespace granular
{
namespace
{
template <class Value>
void add_rows(ValueRange& range, const Block& block, std::int64_t first, std::size_t rows)
{
  const auto begin = static_cast<std::size_t>(first) * range.components().size();
  range.add(static_cast<const Value*>(block.data()) + begin, rows);
}
}

TableArray* find_array(Table& table, std::string_view name)
{
  const auto found = std::ranges::find_if(
    table.arrays, [&](const TableArray& array) { return array.info.name == name; });
  return found == table.arrays.end() ? nullptr : &*found;
}

void add_array(Table& frame, std::string_view name, ValueType type, int components, Block block)
{
  const std::vector<int> no_columns(static_cast<std::size_t>(components), -1);
  ArrayInfo info{ .name = std::string(name), .type = type, .columns = no_columns };
  frame.arrays.push_back({ std::move(info), std::move(block), {}, {} });
}

FrameRanges::FrameRanges(const Table& frame)
{
  for (const TableArray& array : frame.arrays)
  {
    const bool text = array.info.type == ValueType::Text;
    arrays_.emplace_back(text ? 0 : array.info.columns.size());
  }
}

void FrameRanges::add(const Table& frame, std::int64_t first, std::size_t rows, bool single)
{
  if (frame.points.bytes() > 0)
  {
    (single ? add_rows<float> : add_rows<double>)(points_, frame.points, first, rows);
  }
  for (std::size_t i = 0; i < arrays_.size(); ++i)
  {
    const Block& block = frame.arrays[i].block;
    switch (frame.arrays[i].info.type)
    {
      case ValueType::Int32:
        add_rows<std::int32_t>(arrays_[i], block, first, rows);
        break;
      case ValueType::Int64:
        add_rows<std::int64_t>(arrays_[i], block, first, rows);
        break;
      case ValueType::Float64:
        add_rows<double>(arrays_[i], block, first, rows);
        break;
      default: // texts
        break;
    }
  }
}

void FrameRanges::add(const FrameRanges& other)
{
  points_.add(other.points_);
  for (std::size_t i = 0; i < arrays_.size(); ++i)
  {
    arrays_[i].add(other.arrays_[i]);
  }
}

void FrameRanges::store(Table& frame) const
{
  frame.points_range = points_;
  for (std::size_t i = 0; i < arrays_.size(); ++i)
  {
    frame.arrays[i].range = arrays_[i];
  }
}

FrameView view_frame(const Table& frame, const Vector3& point_origin)
{
  FrameView view;
  view.header = frame.header;
  view.has_box = frame.header.has_box;
  view.rows = frame.rows;
  if (frame.points.data())
  {
    view.points = view_rows("", ValueType::Float64, frame.points.data(), 3);
  }
  view.coordinates = frame.coordinates;
  view.point_origin = point_origin;
  for (const TableArray& array : frame.arrays)
  {
    if (array.info.type != ValueType::Text)
    {
      view.arrays.push_back(
        view_rows(array.info.name, array.info.type, array.block.data(), array.info.components()));
    }
  }
  return view;
}
}
