// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/dump/read/frame_decoder.h"

#include "granular/geometry/box.h"
#include "granular/sorting/text_dictionary.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <type_traits>

namespace granular
{
namespace
{
template <typename T>
void copy_scaled(const char* from, std::ptrdiff_t from_stride, char* to, std::ptrdiff_t to_stride,
  double scale, std::size_t count) noexcept
{
  for (std::size_t i = 0; i < count; ++i)
  {
    *reinterpret_cast<double*>(to) = static_cast<double>(*reinterpret_cast<const T*>(from)) * scale;
    from += from_stride;
    to += to_stride;
  }
}

/// Moves rows to the beginning; width: of a row.
template <class Width>
void move_rows(char* first, std::span<const std::uint32_t> rows, Width width) noexcept
{
  char* to = first;
  for (const std::uint32_t row : rows)
  {
    std::memmove(to, first + row * static_cast<std::size_t>(width), width);
    to += width;
  }
}
}

ChunkDecoder::ChunkDecoder(FrameLayout& layout, const Request& request)
  : layout_(layout)
  , request_(request)
  , scratch_(std::make_unique<char[]>(layout.scratch_bytes))
{
  for (const auto& [column, wire] : layout.wires)
  {
    sinks_.push_back(
      { static_cast<std::uint32_t>(column), wire.type, nullptr, wire.first.stride, wire.open });
  }
  if (request.stride > 1 || request.keep_id || layout.region)
  {
    keep_.resize(layout.batch);
  }
  const auto id = layout.wires.find(layout.id_column);
  if ((request.stride > 1 || request.keep_id) && id != layout.wires.end() &&
    id->second.type == ValueType::Int64)
  {
    choice_.column = static_cast<std::uint32_t>(id->first);
    choice_.passes = request.keep_id;
    if (request.stride > 1)
    {
      choice_.passes = [&request](std::int64_t number)
      { return number % request.stride == 0 && (!request.keep_id || request.keep_id(number)); };
    }
  }
}

void ChunkDecoder::decode(RowReader& reader, std::int64_t number, std::int64_t room,
  const Where& where, DecodedChunk& chunk, FrameRanges& ranges)
{
  row_ = chunk.row;
  std::vector<TextDictionary> words(layout_.texts.size());
  while (chunk.rows < room)
  {
    this->aim();
    const std::int64_t wanted =
      std::min(static_cast<std::int64_t>(layout_.batch), room - chunk.rows);
    const RowCounts got = this->decode_batch(reader, wanted);
    if (got.rows == 0)
    {
      break;
    }
    const auto count = static_cast<std::size_t>(got.decoded);
    for (std::size_t i = 0; i < layout_.texts.size(); ++i)
    {
      const TextWire& wire = layout_.texts[i];
      auto* const to = static_cast<std::int32_t*>(layout_.frame.arrays[wire.array].block.data());
      const auto* const from =
        reinterpret_cast<const std::string_view*>(wire.texts.at(0, scratch_.get()));
      std::transform(from, from + count, to + row_,
        [&](std::string_view text) { return words[i].index(text, where); });
    }
    const std::size_t kept = this->finish_batch(count, number + chunk.rows, chunk.moved);
    if (request_.ranges)
    {
      // while the rows are in the cache: whoever shows them asks for their range
      ranges.add(layout_.frame, row_, kept, request_.single_precision);
    }
    row_ += static_cast<std::int64_t>(kept);
    chunk.rows += got.rows;
  }
  chunk.kept = row_ - chunk.row;
  for (TextDictionary& dictionary : words)
  {
    chunk.words.push_back(dictionary.take());
  }
}

/// Decodes rows: where ids tell which stay, others may have been passed over.
RowCounts ChunkDecoder::decode_batch(RowReader& reader, std::int64_t wanted)
{
  if (choice_.passes)
  {
    return reader.decode_chosen(sinks_, wanted, choice_);
  }
  const std::int64_t rows = reader.decode(sinks_, wanted);
  return { rows, rows };
}

/// Points the sinks at where the next row goes.
void ChunkDecoder::aim()
{
  auto sink = sinks_.begin();
  for (const auto& [column, wire] : layout_.wires)
  {
    sink++->data = wire.first.at(row_, scratch_.get());
  }
}

/// Returns how many of the rows stay.
std::size_t ChunkDecoder::finish_batch(std::size_t count, std::int64_t number, Vector3& moved)
{
  this->copy_batch(count);
  if (layout_.points)
  {
    this->convert(*layout_.points, count);
  }
  if (!keep_.empty())
  {
    this->choose_rows(count, number);
  }
  if (layout_.points && request_.single_precision)
  {
    this->narrow(count, moved);
  }
  if (keep_.empty())
  {
    return count;
  }
  kept_.resize(count);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    kept_[kept] = static_cast<std::uint32_t>(i);
    kept += std::size_t{ keep_[i] != 0 };
  }
  kept_.resize(kept);
  if (kept < count)
  {
    layout_.for_each_block([&](Block& block, std::size_t width) { this->compact(block, width); });
  }
  return kept;
}

void ChunkDecoder::copy_batch(std::size_t count)
{
  for (const auto& [column, wire] : layout_.wires)
  {
    const char* const from = wire.first.at(row_, scratch_.get());
    for (const Wire::Copy& copy : wire.copies)
    {
      char* const to = copy.to.at(row_, scratch_.get());
      switch (wire.type)
      {
        case ValueType::Int32:
          copy_scaled<std::int32_t>(from, wire.first.stride, to, copy.to.stride, copy.scale, count);
          break;
        case ValueType::Int64:
          copy_scaled<std::int64_t>(from, wire.first.stride, to, copy.to.stride, copy.scale, count);
          break;
        case ValueType::Float64:
          copy_scaled<double>(from, wire.first.stride, to, copy.to.stride, copy.scale, count);
          break;
        default: // no text is ever copied to a number
          break;
      }
    }
  }
}

/// Rounds points to floats, and measures how far those of rows that stay move.
void ChunkDecoder::narrow(std::size_t count, Vector3& moved)
{
  const auto* from = reinterpret_cast<const double*>(layout_.points->xyz.at(row_, scratch_.get()));
  auto* to = static_cast<float*>(layout_.frame.points.data()) + 3 * row_;
  for (std::size_t i = 0; i < count; ++i, from += 3, to += 3)
  {
    const bool stays = keep_.empty() || keep_[i] != 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      to[axis] = static_cast<float>(from[axis]);
      const double distance = std::abs(static_cast<double>(to[axis]) - from[axis]);
      moved[axis] = stays && distance > moved[axis] ? distance : moved[axis];
    }
  }
}

void ChunkDecoder::convert(const PointsWire& wire, std::size_t count)
{
  std::span<const double> images;
  if (wire.images)
  {
    images = { reinterpret_cast<const double*>(wire.images->at(row_, scratch_.get())), 3 * count };
  }
  convert_positions(wire.plan, layout_.frame.header.box, wire.point_origin, images,
    { reinterpret_cast<double*>(wire.xyz.at(row_, scratch_.get())), 3 * count });
}

/// Sets keep_ for each row of the batch.
void ChunkDecoder::choose_rows(std::size_t count, std::int64_t number)
{
  std::fill(keep_.begin(), keep_.end(), char{ 1 });
  if (request_.stride > 1 || request_.keep_id)
  {
    this->choose_by_id(count, number);
  }
  if (layout_.region)
  {
    this->convert(*layout_.region, count);
    const auto* point =
      reinterpret_cast<const double*>(layout_.region->xyz.at(row_, scratch_.get()));
    for (std::size_t i = 0; i < count; ++i, point += 3)
    {
      keep_[i] = keep_[i] && contains(request_.region, point);
    }
  }
}

/// Chooses rows by their ids: integers by the choice, doubles if they are whole. Without ids rows count, and no id passes.
void ChunkDecoder::choose_by_id(std::size_t count, std::int64_t number)
{
  const auto id = layout_.wires.find(layout_.id_column);
  if (id == layout_.wires.end())
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      keep_[i] =
        !request_.keep_id && (number + static_cast<std::int64_t>(i)) % request_.stride == 0;
    }
    return;
  }
  const char* from = id->second.first.at(row_, scratch_.get());
  for (std::size_t i = 0; i < count; ++i, from += id->second.first.stride)
  {
    if (id->second.type == ValueType::Float64)
    {
      double value = 0;
      std::memcpy(&value, from, sizeof value);
      keep_[i] = std::fmod(value, static_cast<double>(request_.stride)) == 0 &&
        (!request_.keep_id ||
          (std::abs(value) < 0x1p63 && request_.keep_id(static_cast<std::int64_t>(value))));
    }
    else
    {
      std::int64_t value = 0;
      std::memcpy(&value, from, sizeof value);
      keep_[i] = choice_.passes(value);
    }
  }
}

/// Moves the rows that stay together, from where the batch begins.
void ChunkDecoder::compact(Block& block, std::size_t width) const
{
  char* const first = static_cast<char*>(block.data()) + static_cast<std::size_t>(row_) * width;
  switch (width) // known to the compiler, a move is one instruction or two
  {
    case sizeof(std::int32_t):
      return move_rows(first, kept_, std::integral_constant<std::size_t, 4>());
    case sizeof(double):
      return move_rows(first, kept_, std::integral_constant<std::size_t, 8>());
    case 3 * sizeof(float):
      return move_rows(first, kept_, std::integral_constant<std::size_t, 12>());
    case 3 * sizeof(double):
      return move_rows(first, kept_, std::integral_constant<std::size_t, 24>());
    default:
      return move_rows(first, kept_, width);
  }
}
}
