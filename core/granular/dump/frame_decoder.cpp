// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/frame_decoder.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

namespace granular
{
namespace
{
/// Rows decoded at a time: what is made from them is made while they are in the cache.
constexpr std::size_t batch_rows = 2048;

/// Batches between two reports of progress: a few milliseconds.
constexpr int report_batches = 32;

constexpr ColumnSink::Kind kind_of(ValueType type) noexcept
{
  constexpr ColumnSink::Kind kinds[] = { ColumnSink::Kind::Int32, ColumnSink::Kind::Int64,
    ColumnSink::Kind::Float64, ColumnSink::Kind::Text };
  return kinds[static_cast<std::size_t>(type)];
}

template <typename T>
void copy_scaled(const char* from, std::ptrdiff_t stride, const Wire::Copy& copy, char* to,
  std::size_t count) noexcept
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const double value = static_cast<double>(*reinterpret_cast<const T*>(from)) * copy.scale;
    *reinterpret_cast<double*>(to) = value;
    from += stride;
    to += copy.to.stride;
  }
}

bool restricts(const std::array<double, 6>& region) noexcept
{
  return region[0] <= region[1] || region[2] <= region[3] || region[4] <= region[5];
}

/// A coordinate that is no number is in no region.
bool contains(const std::array<double, 6>& region, const double* point) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double lo = region[2 * axis];
    const double hi = region[2 * axis + 1];
    if (lo <= hi && !(point[axis] >= lo && point[axis] <= hi))
    {
      return false;
    }
  }
  return true;
}
}

void Points::convert(const Box& box, std::int64_t row, std::size_t count)
{
  const std::span<double> points(reinterpret_cast<double*>(xyz.at(row)), 3 * count);
  convert_positions(plan, box, point_origin, images, points);
}

std::int64_t PieceList::rows() const noexcept
{
  return std::accumulate(entries.begin(), entries.end(), std::int64_t{ 0 },
    [](std::int64_t rows, const FrameEntry* entry) { return rows + entry->rows; });
}

FrameDecoder::FrameDecoder(
  const PieceList& pieces, const ColumnSchema& schema, const DumpRequest& request, Notices& notices)
  : pieces_(pieces)
  , schema_(schema)
  , request_(request)
  , notices_(notices)
{
  this->open(0);
  where_ = where_of(source_->path(), *pieces.entries[0]);
  header_ = rows_->header();
  header_.rows = pieces.rows();
  this->lay_arrays();
  this->lay_points();
  this->lay_filters();
}

void FrameDecoder::open(std::size_t piece)
{
  rows_.reset();
  source_ = pieces_.open(piece);
  rows_ = open_rows(*source_, *pieces_.entries[piece]);
}

/// Memory for a batch.
Destination FrameDecoder::scratch(std::size_t bytes_a_row)
{
  scratch_.push_back(std::make_unique<char[]>(bytes_a_row * batch_rows));
  return { scratch_.back().get(), static_cast<std::ptrdiff_t>(bytes_a_row), true };
}

/// Adds a destination to a column. The first one gets the values as they are parsed; others get
/// copies as doubles.
void FrameDecoder::want(int column, ValueType type, Destination to, double scale)
{
  const auto found = wires_.find(column);
  if (found != wires_.end())
  {
    found->second.copies.push_back({ to, scale });
  }
  else if (scale == 1)
  {
    wires_[column] = { kind_of(type), to, {} };
  }
  else
  {
    wires_[column] = { kind_of(type), this->scratch(size_of(type)), { { to, scale } } };
  }
}

void FrameDecoder::lay_arrays()
{
  for (const ArrayInfo& info : schema_.arrays())
  {
    if (request_.wanted ? !request_.wanted(info) : info.position_form)
    {
      continue;
    }
    DumpArray array{ info, {}, {} };
    const std::size_t width = size_of(info.type);
    const std::size_t stride = width * info.columns.size();
    array.block = Block(stride * static_cast<std::size_t>(header_.rows));
    Destination to = { static_cast<char*>(array.block.data()), static_cast<std::ptrdiff_t>(stride),
      false };
    if (info.type == ValueType::Text)
    {
      to = this->scratch(sizeof(std::string_view));
      texts_.push_back({ frame_.arrays.size(), to.base, {} });
    }
    for (const int column : info.columns)
    {
      this->want(column, info.type, to, info.scale);
      to.base += width;
    }
    frame_.arrays.push_back(std::move(array));
  }
}

/// Wires the columns that points are made from.
void FrameDecoder::lay(Points& points)
{
  Destination to = points.xyz;
  for (const PositionPlan::Axis& axis : points.plan.axes)
  {
    if (axis.column >= 0)
    {
      this->want(axis.column, ValueType::Float64, to);
    }
    to.base += sizeof(double);
  }
  if (std::any_of(
        points.plan.images.begin(), points.plan.images.end(), [](int c) { return c >= 0; }))
  {
    points.images.assign(3 * batch_rows, 0);
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (points.plan.images[axis] >= 0)
    {
      char* const base = reinterpret_cast<char*>(points.images.data() + axis);
      this->want(points.plan.images[axis], ValueType::Float64, { base, 3 * sizeof(double), true });
    }
  }
}

void FrameDecoder::lay_points()
{
  points_.plan = plan_positions(schema_, header_.box, request_.coordinates, where_, notices_);
  points_.point_origin = request_.point_origin;
  const std::size_t stride = 3 * (request_.single_precision ? sizeof(float) : sizeof(double));
  frame_.coordinates = points_.plan.coordinates;
  frame_.points = Block(stride * static_cast<std::size_t>(header_.rows));
  points_.xyz = request_.single_precision
    ? this->scratch(3 * sizeof(double))
    : Destination{ static_cast<char*>(frame_.points.data()), 3 * sizeof(double), false };
  this->lay(points_);
}

void FrameDecoder::lay_filters()
{
  const int id = schema_.find(ColumnRole::Id);
  if (request_.stride > 1)
  {
    keep_.assign(batch_rows, 1);
  }
  if (restricts(request_.region))
  {
    Notices known; // lay_points has said what there is to say
    keep_.assign(batch_rows, 1);
    region_.emplace();
    region_->plan = plan_positions(schema_, header_.box, Coordinates::Absolute, where_, known);
    if (region_->plan.coordinates != Coordinates::Absolute &&
      request_.coordinates != Coordinates::Absolute)
    {
      notices_.push_back({ where_,
        std::string(
          "expected image counts ix iy iz to make Absolute coordinates for the region, got "
          "none; the region is in ") +
          to_string(region_->plan.coordinates) + " coordinates" });
    }
    region_->xyz = this->scratch(3 * sizeof(double));
    this->lay(*region_);
  }
  if (id >= 0 && (request_.stride > 1 || request_.sort_by_id) && !wires_.contains(id))
  {
    // as an array of its own, so that filters treat it like all others
    ids_ = Block(sizeof(std::int64_t) * static_cast<std::size_t>(header_.rows));
    this->want(
      id, ValueType::Int64, { static_cast<char*>(ids_.data()), sizeof(std::int64_t), false });
  }
}

/// Points the sinks at where the next row goes.
void FrameDecoder::aim(std::vector<ColumnSink>& sinks) const
{
  auto sink = sinks.begin();
  for (const auto& [column, wire] : wires_)
  {
    sink++->data = wire.first.at(row_);
  }
}

std::optional<Misfit> FrameDecoder::run(Progress& progress)
{
  std::vector<ColumnSink> sinks;
  for (const auto& [column, wire] : wires_)
  {
    sinks.push_back({ static_cast<std::uint32_t>(column), wire.kind, nullptr, wire.first.stride });
  }
  for (std::size_t piece = 0; piece < pieces_.entries.size(); ++piece)
  {
    if (piece > 0)
    {
      this->open(piece);
    }
    this->run_piece(sinks, progress);
    if (std::optional<Misfit> misfit = rows_->misfit())
    {
      return misfit;
    }
    rows_->note(notices_);
  }
  progress.step(1);
  return std::nullopt;
}

/// Decodes the rows of the piece at hand, or up to a value that does not fit.
void FrameDecoder::run_piece(std::vector<ColumnSink>& sinks, Progress& progress)
{
  const std::int64_t before = seen_;
  const auto all = static_cast<double>(std::max(std::int64_t{ 1 }, header_.rows));
  const auto rows = static_cast<double>(rows_->header().rows);
  for (int batch = 0;; ++batch)
  {
    if (batch % report_batches == 0)
    {
      progress.step((static_cast<double>(before) + rows_->fraction() * rows) / all);
    }
    this->aim(sinks);
    const std::int64_t count = rows_->decode(sinks, batch_rows);
    if (count == 0)
    {
      return;
    }
    this->finish_batch(static_cast<std::size_t>(count));
  }
}

void FrameDecoder::finish_batch(std::size_t count)
{
  this->copy_batch(count);
  for (TextColumn& column : texts_)
  {
    column.index(frame_.arrays[column.array], row_, count, where_);
  }
  points_.convert(header_.box, row_, count);
  if (request_.single_precision)
  {
    const auto* const from = reinterpret_cast<const double*>(points_.xyz.base);
    std::transform(from, from + 3 * count, static_cast<float*>(frame_.points.data()) + 3 * row_,
      [](double coordinate) { return static_cast<float>(coordinate); });
  }
  std::size_t kept = count;
  if (!keep_.empty())
  {
    this->choose_rows(count);
    kept = static_cast<std::size_t>(
      std::count(keep_.begin(), keep_.begin() + static_cast<std::ptrdiff_t>(count), 1));
  }
  if (kept < count)
  {
    const std::size_t point = 3 * (request_.single_precision ? sizeof(float) : sizeof(double));
    this->compact(frame_.points, point, count);
    this->compact(ids_, sizeof(std::int64_t), count);
    for (DumpArray& array : frame_.arrays)
    {
      this->compact(array.block, size_of(array.info.type) * array.info.columns.size(), count);
    }
  }
  seen_ += static_cast<std::int64_t>(count);
  row_ += static_cast<std::int64_t>(kept);
}

void FrameDecoder::copy_batch(std::size_t count)
{
  for (const auto& [column, wire] : wires_)
  {
    const char* const from = wire.first.at(row_);
    for (const Wire::Copy& copy : wire.copies)
    {
      char* const to = copy.to.at(row_);
      switch (wire.kind)
      {
        case ColumnSink::Kind::Int32:
          copy_scaled<std::int32_t>(from, wire.first.stride, copy, to, count);
          break;
        case ColumnSink::Kind::Int64:
          copy_scaled<std::int64_t>(from, wire.first.stride, copy, to, count);
          break;
        case ColumnSink::Kind::Float64:
          copy_scaled<double>(from, wire.first.stride, copy, to, count);
          break;
        case ColumnSink::Kind::Text:
          break; // no text is ever copied to a number
      }
    }
  }
}

/// Sets keep_ for each row of the batch.
void FrameDecoder::choose_rows(std::size_t count)
{
  std::fill(keep_.begin(), keep_.end(), char{ 1 });
  const auto id = wires_.find(schema_.find(ColumnRole::Id));
  for (std::size_t i = 0; request_.stride > 1 && i < count; ++i)
  {
    std::int64_t number = seen_ + static_cast<std::int64_t>(i);
    if (id != wires_.end())
    {
      const char* const from = id->second.first.at(row_);
      std::memcpy(
        &number, from + static_cast<std::ptrdiff_t>(i) * id->second.first.stride, sizeof number);
    }
    keep_[i] = number % request_.stride == 0;
  }
  if (region_)
  {
    region_->convert(header_.box, row_, count);
    const auto* point = reinterpret_cast<const double*>(region_->xyz.base);
    for (std::size_t i = 0; i < count; ++i, point += 3)
    {
      keep_[i] = keep_[i] && contains(request_.region, point);
    }
  }
}

/// Moves the rows that stay together, from where the batch begins.
void FrameDecoder::compact(Block& block, std::size_t width, std::size_t count) const
{
  if (block.bytes() == 0)
  {
    return;
  }
  const char* from = static_cast<char*>(block.data()) + static_cast<std::size_t>(row_) * width;
  char* to = static_cast<char*>(block.data()) + static_cast<std::size_t>(row_) * width;
  for (std::size_t i = 0; i < count; ++i, from += width)
  {
    if (keep_[i])
    {
      std::memmove(to, from, width);
      to += width;
    }
  }
}

DumpFrame FrameDecoder::take(Block& ids)
{
  const auto rows = static_cast<std::size_t>(row_);
  frame_.rows = row_;
  frame_.points.shrink(3 * rows * (request_.single_precision ? sizeof(float) : sizeof(double)));
  for (DumpArray& array : frame_.arrays)
  {
    array.block.shrink(rows * size_of(array.info.type) * array.info.columns.size());
  }
  frame_.header = std::move(header_);
  frame_.schema = schema_;
  ids = std::move(ids_);
  return std::move(frame_);
}
}
