// SPDX-License-Identifier: BSD-3-Clause
// A text dump from memory, all the way: index, then every frame with several requests. Whatever
// the bytes are, there is an Error or a frame of the rows it says; every instruction set decodes
// the rows alike; and a binary dump of the same numbers gives the same arrays.
#include "dump_checks.h"

#include "granular/formats/dump/grammar/dump_files.h"
#include "granular/formats/dump/grammar/text_dump.h"
#include "granular/formats/dump/write/encode_header.h"
#include "granular/text/line_scan.h"
#include "granular/text/row_text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

using namespace granular;

namespace
{
/// All columns as doubles, or as texts.
RowResult decode(const char* first, const char* last, std::size_t columns, bool texts, Simd simd,
  std::vector<char>& memory)
{
  constexpr std::size_t slot = sizeof(std::string_view);
  const auto lines = static_cast<std::size_t>(std::count(first, last, '\n'));
  memory.assign((lines + 1) * columns * slot, 0);
  std::vector<ColumnSink> sinks;
  for (std::size_t i = 0; i < columns; ++i)
  {
    sinks.push_back({ static_cast<std::uint32_t>(i), texts ? ValueType::Text : ValueType::Float64,
      memory.data() + i * slot, static_cast<std::ptrdiff_t>(columns * slot) });
  }
  RowMemory room;
  const RowResult result = decode_rows(first, last, static_cast<std::uint32_t>(columns), sinks,
    static_cast<std::int64_t>(lines), room, simd);
  memory.resize(static_cast<std::size_t>(result.rows) * columns * slot);
  return result;
}

void compare_paths(std::string_view rows, std::size_t columns)
{
  rows = rows.substr(0, rows.rfind('\n') + 1);
  if (rows.size() * columns > (std::size_t{ 1 } << 22))
  {
    return; // a table of all that would be slow to fill
  }
  PaddedBuffer buffer(rows.size());
  rows.copy(buffer.data(), rows.size());
  const char* const first = buffer.data();
  const char* const last = first + rows.size();
  for (const bool texts : { false, true })
  {
    std::vector<char> plain_memory;
    const RowResult plain = decode(first, last, columns, texts, Simd::Portable, plain_memory);
    for (const Simd simd : instruction_sets())
    {
      std::vector<char> memory;
      const RowResult other = decode(first, last, columns, texts, simd, memory);
      require(other.ptr == plain.ptr && other.rows == plain.rows && other.status == plain.status &&
          other.column == plain.column,
        "decode_rows: results differ");
      require(memory == plain_memory, "decode_rows: values differ");
    }
  }
  const LineScan plain = scan_lines(first, last, 'I', {}, Simd::Portable);
  for (const Simd simd : instruction_sets())
  {
    const LineScan other = scan_lines(first, last, 'I', {}, simd);
    require(other.ptr == plain.ptr && other.feeds == plain.feeds &&
        other.blank_lines == plain.blank_lines && other.after_last_feed == plain.after_last_feed &&
        other.state.start == plain.state.start && other.state.blank == plain.state.blank,
      "scan_lines: results differ");
  }
}

void index(std::string_view text, FileIndex& index)
{
  const auto source = open_memory(text);
  Progress progress;
  index.kinds = index.kinds ? index.kinds : std::make_shared<FrameKinds>();
  try
  {
    index_text_dump(*source, index, progress);
  }
  catch (const Error&)
  {
    // a limit
  }
  const auto size = static_cast<std::int64_t>(text.size());
  for (const FrameEntry& frame : index.frames)
  {
    require(
      frame.offset >= 0 && frame.offset < frame.end && frame.end <= size, "the places of a frame");
    require(frame.rows >= 0 && frame.rows <= frame.end - frame.offset, "more rows than bytes");
  }
}

double number_of(const TableArray& array, std::size_t at)
{
  const auto* const bytes =
    static_cast<const char*>(array.block.data()) + at * size_of(array.info.type);
  const auto load = [&](auto value)
  {
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
  };
  switch (array.info.type)
  {
    case ValueType::Int32:
      return load(std::int32_t());
    case ValueType::Int64:
      return load(std::int64_t());
    case ValueType::Float32:
      return load(float());
    default:
      return load(double());
  }
}

/// A frame as a binary dump; nothing if doubles cannot hold it.
std::optional<std::string> as_binary(const ByteSource& source, const FrameEntry& entry)
{
  constexpr std::int64_t most_values = 1 << 14;
  constexpr double largest_integer = 9007199254740992.0;
  Request request;
  request.points = false; // coordinates are columns like others
  request.wanted = [](std::string_view, bool) { return true; };
  Notices notices;
  Progress progress;
  Table frame;
  try
  {
    frame = read_dump(source, entry, request, notices, progress);
  }
  catch (const Error&)
  {
    return std::nullopt;
  }
  std::vector<std::string> names;
  for (const ColumnInfo& column : frame.schema.columns())
  {
    names.push_back(column.name);
  }
  if (frame.rows * static_cast<std::int64_t>(names.size()) > most_values)
  {
    return std::nullopt;
  }
  std::vector<double> values(
    static_cast<std::size_t>(frame.rows) * names.size(), std::numeric_limits<double>::quiet_NaN());
  for (const TableArray& array : frame.arrays)
  {
    const std::size_t width = array.info.columns.size();
    const bool derived = array.info.scale != 1; // a radius, beside its diameter
    for (std::size_t i = 0; !derived && i < width * static_cast<std::size_t>(frame.rows); ++i)
    {
      const auto column = static_cast<std::size_t>(array.info.columns[i % width]);
      const double value = number_of(array, i);
      if (array.info.type == ValueType::Text ||
        (array.info.type == ValueType::Int64 && !(std::abs(value) < largest_integer)))
      {
        return std::nullopt;
      }
      values[i / width * names.size() + column] = value;
    }
  }
  DumpFormat format;
  format.binary = true;
  format.units = !frame.header.units.empty();
  format.time = frame.header.time.has_value();
  const ChunkLengths chunks(frame.rows, static_cast<std::int64_t>(names.size()),
    std::max<std::int64_t>(40, static_cast<std::int64_t>(names.size())));
  std::string bytes;
  try
  {
    bytes = encode_header(frame.header, names, format, chunks, true);
  }
  catch (const Error&)
  {
    return std::nullopt; // a box that binary dumps cannot hold
  }
  for (std::int64_t row = 0; row < frame.rows; ++row)
  {
    if (chunks.begins(row))
    {
      const std::int32_t count = chunks.values(row);
      bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
    }
    bytes.append(
      reinterpret_cast<const char*>(values.data() + static_cast<std::size_t>(row) * names.size()),
      8 * names.size());
  }
  return bytes;
}

/// The same numbers, text and binary, give the same arrays.
void compare_with_binary(
  const ByteSource& text, const FrameEntry& entry, const std::vector<Request>& every)
{
  const auto bytes = as_binary(text, entry);
  if (!bytes)
  {
    return;
  }
  const auto source = open_memory(*bytes);
  FileIndex binary;
  Progress progress;
  index_dump(*source, binary, progress);
  require(binary.frames.size() == 1, "a binary frame of the same numbers");
  require(binary.frames[0].rows == entry.rows && binary.frames[0].timestep == entry.timestep,
    "the same frame");
  for (const Request& request : every)
  {
    constexpr std::size_t chunk = std::size_t{ 1 } << 18;
    const Reading one = read_frame(text, entry, request, 1, chunk);
    const Reading other = read_frame(*source, binary.frames[0], request, 1, chunk);
    require(one.error.empty() == other.error.empty(), "text and binary: wrong or not");
    // the rows that are decoded decide the type of a column: with a stride these are fewer in a text
    require(!one.error.empty() || !(one.schema == other.schema) || one.values == other.values,
      "text and binary: values");
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static_cast<void>(is_text_dump(text));
  FileIndex all;
  index(text, all);
  FileIndex grown; // as if the file had been half as long before
  index(text.substr(0, size / 2), grown);
  index(text, grown);

  const auto source = open_memory(text);
  static const std::vector<Request> every = requests();
  constexpr std::size_t most_frames = 8;
  for (std::size_t i = 0; i < std::min(all.frames.size(), most_frames); ++i)
  {
    const FrameEntry& entry = all.frames[i];
    for (const Request& request : every)
    {
      check_readings(*source, entry, request);
    }
    compare_with_binary(*source, entry, every);
    compare_paths(text.substr(static_cast<std::size_t>(entry.offset),
                    static_cast<std::size_t>(entry.end - entry.offset)),
      entry.kind->schema.columns().size());
  }
  compare_paths(text, 3);
  return 0;
}
