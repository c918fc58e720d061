// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/read/frame_layout.h"

#include "granular/geometry/box.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
/// Texts need memory for a batch, each column by itself: many of them get a shorter one.
std::size_t batch_for(const ColumnSchema& schema) noexcept
{
  constexpr std::size_t most_rows = 2048;
  constexpr std::size_t most_texts = std::size_t{ 1 } << 18; // 4 MiB
  const auto texts = static_cast<std::size_t>(
    std::ranges::count(schema.arrays(), ValueType::Text, &ArrayInfo::type));
  return std::clamp(most_texts / std::max<std::size_t>(texts, 1), std::size_t{ 1 }, most_rows);
}
}

FrameLayout::FrameLayout(const ColumnSchema& schema, const FrameHeader& header,
  const Request& request, std::int64_t room, const Where& where, Notices& notices)
  : rows(room)
  , point_bytes(3 * (request.single_precision ? sizeof(float) : sizeof(double)))
  , batch(batch_for(schema))
  , id_column(schema.find(ColumnRole::Id))
  , schema_(schema)
  , request_(request)
{
  frame.header = header;
  this->lay_arrays();
  if (request.points)
  {
    this->lay_points(where, notices);
  }
  this->lay_filters(where, notices);
}

/// Memory for a batch.
Destination FrameLayout::scratch(std::size_t bytes_a_row)
{
  const Destination to = { nullptr, scratch_bytes, static_cast<std::ptrdiff_t>(bytes_a_row), true };
  scratch_bytes += bytes_a_row * batch;
  return to;
}

/// Adds a destination to a column. The first one gets the values as they are parsed; others get
/// copies as doubles.
void FrameLayout::want(int column, ValueType type, Destination to, double scale)
{
  const auto found = wires.find(column);
  if (found != wires.end())
  {
    found->second.copies.push_back({ to, scale });
  }
  else if (scale == 1)
  {
    const bool open = schema_.columns()[static_cast<std::size_t>(column)].open;
    wires[column] = { type, to, {}, open && type == ValueType::Float64 };
  }
  else
  {
    wires[column] = { type, this->scratch(size_of(type)), { { to, scale } } };
  }
}

void FrameLayout::lay_arrays()
{
  for (const ArrayInfo& info : schema_.arrays())
  {
    if (!is_wanted(request_.wanted, info))
    {
      continue;
    }
    TableArray array{ info, {}, {}, {} };
    const std::size_t width = size_of(info.type);
    const std::size_t stride = width * info.columns.size();
    array.block = Block(stride * static_cast<std::size_t>(rows), request_.pool);
    Destination to = { static_cast<char*>(array.block.data()), 0,
      static_cast<std::ptrdiff_t>(stride), false };
    if (info.type == ValueType::Text)
    {
      to = this->scratch(sizeof(std::string_view));
      texts.push_back({ frame.arrays.size(), to });
    }
    for (const int column : info.columns)
    {
      this->want(column, info.type, to, info.scale);
      to.base += to.scratch ? 0 : width; // a text has one component
    }
    frame.arrays.push_back(std::move(array));
  }
}

/// Wires the columns that points are made from.
void FrameLayout::lay(PointsWire& wire)
{
  const auto component = [](Destination of, std::size_t axis)
  {
    of.offset += of.scratch ? axis * sizeof(double) : 0;
    of.base += of.scratch ? 0 : axis * sizeof(double);
    return of;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (wire.plan.axes[axis].column >= 0)
    {
      this->want(wire.plan.axes[axis].column, ValueType::Float64, component(wire.xyz, axis));
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (wire.plan.images[axis] >= 0)
    {
      if (!wire.images)
      {
        wire.images = this->scratch(3 * sizeof(double));
      }
      this->want(wire.plan.images[axis], ValueType::Float64, component(*wire.images, axis));
    }
  }
}

void FrameLayout::lay_points(const Where& where, Notices& notices)
{
  points.emplace();
  points->plan = plan_positions(schema_, frame.header.box, request_.coordinates, where, notices);
  if (frame.header.rows > 0)
  {
    check_scale(points->plan, frame.header.box, where);
  }
  points->point_origin = request_.point_origin;
  frame.coordinates = points->plan.coordinates;
  frame.points = Block(point_bytes * static_cast<std::size_t>(rows), request_.pool);
  points->xyz = request_.single_precision
    ? this->scratch(3 * sizeof(double))
    : Destination{ static_cast<char*>(frame.points.data()), 0, 3 * sizeof(double), false };
  this->lay(*points);
}

void FrameLayout::lay_filters(const Where& where, Notices& notices)
{
  if (restricts(request_.region))
  {
    Notices known; // lay_points has said what there is to say
    region.emplace();
    region->plan = plan_positions(schema_, frame.header.box, Coordinates::Absolute, where, known);
    if (region->plan.coordinates != Coordinates::Absolute &&
      request_.coordinates != Coordinates::Absolute)
    {
      notices.push_back({ where,
        std::string(
          "expected image counts ix iy iz to make Absolute coordinates for the region, got "
          "none; the region is in ") +
          to_string(region->plan.coordinates) + " coordinates" });
    }
    region->xyz = this->scratch(3 * sizeof(double));
    this->lay(*region);
  }
  const bool needs_ids = request_.stride > 1 || request_.keep_id || request_.sort_by_id;
  if (id_column >= 0 && needs_ids && !wires.contains(id_column))
  {
    // as an array of its own, so that filters treat it like all others
    ids = Block(sizeof(std::int64_t) * static_cast<std::size_t>(rows), request_.pool);
    this->want(id_column, ValueType::Int64,
      { static_cast<char*>(ids.data()), 0, sizeof(std::int64_t), false });
  }
}

Table FrameLayout::take(std::int64_t kept, Block& to)
{
  frame.rows = kept;
  frame.schema = schema_;
  this->for_each_block([&](Block& block, std::size_t bytes_a_row)
    { block.shrink(static_cast<std::size_t>(kept) * bytes_a_row); });
  to = std::move(ids);
  return std::move(frame);
}
}
