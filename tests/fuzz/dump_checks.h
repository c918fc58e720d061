// SPDX-License-Identifier: BSD-3-Clause
// What the fuzz targets of dumps share: frames are read with several requests, and must be what they
// say.
#ifndef granular_tests_fuzz_dump_checks_h
#define granular_tests_fuzz_dump_checks_h

#include "../support/read_source.h"

#include "granular/memory/block.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
inline void require(bool good, const char* what)
{
  if (!good)
  {
    std::fprintf(stderr, "%s\n", what);
    std::abort();
  }
}

inline void check_frame(const Table& frame, const FrameEntry& entry, const Request& request)
{
  const auto rows = static_cast<std::size_t>(frame.rows);
  const bool filtered = request.stride > 1 || request.region[0] <= request.region[1];
  require(frame.rows == entry.rows || (filtered && frame.rows < entry.rows), "rows");
  require(frame.points.bytes() == 3 * rows * (request.single_precision ? 4 : 8), "points");
  for (const TableArray& array : frame.arrays)
  {
    if (array.info.type == ValueType::Text)
    {
      const auto* const indices = static_cast<const std::int32_t*>(array.block.data());
      for (std::size_t row = 0; row < rows; ++row)
      {
        require(indices[row] >= 0, "index of a word");
        require(static_cast<std::size_t>(indices[row]) < array.words.size(), "index of a word");
      }
    }
    else
    {
      require(array.block.bytes() == rows * array.info.columns.size() * size_of(array.info.type),
        "array");
    }
  }
}

/// What came of reading a frame: its rows, column after column, or what is wrong with it.
struct Reading
{
  std::string error;
  std::string said;                ///< the notices
  std::vector<std::string> values; ///< of texts the words
  ColumnSchema schema;

  bool operator==(const Reading&) const = default;
};

inline std::string values_of(const TableArray& array, std::int64_t rows)
{
  if (array.info.type != ValueType::Text)
  {
    return { static_cast<const char*>(array.block.data()), array.block.bytes() };
  }
  std::string text;
  const auto* const indices = static_cast<const std::int32_t*>(array.block.data());
  for (std::int64_t row = 0; row < rows; ++row)
  {
    text += array.words[static_cast<std::size_t>(indices[row])] + "\n";
  }
  return text;
}

/// Memory that frames before have left: none of it may show in a frame, compared with one in fresh memory.
inline const std::shared_ptr<BlockPool>& used_memory()
{
  static const auto pool = std::make_shared<BlockPool>(std::size_t{ 64 } << 20);
  return pool;
}

/// The bytes of all arrays of some tables.
inline std::string content_of(std::initializer_list<const Table*> tables)
{
  std::string all;
  for (const Table* const rows : tables)
  {
    all.append(static_cast<const char*>(rows->points.data()), rows->points.bytes());
    for (const TableArray& array : rows->arrays)
    {
      all += array.info.name + values_of(array, rows->rows);
    }
  }
  return all;
}

inline Reading read_frame(const ByteSource& source, const FrameEntry& entry, Request request,
  int threads, std::size_t chunk_bytes)
{
  request.threads = threads;
  request.chunk_bytes = chunk_bytes;
  request.pool = threads > 1 ? used_memory() : nullptr;
  Reading reading;
  Notices notices;
  Progress progress;
  try
  {
    const Table frame = read_dump(source, entry, request, notices, progress);
    require(request.pieces > 1 || frame.rows <= entry.rows, "rows");
    if (request.pieces == 1)
    {
      check_frame(frame, entry, request);
    }
    reading.schema = frame.schema;
    reading.values.emplace_back(
      static_cast<const char*>(frame.points.data()), frame.points.bytes());
    for (const TableArray& array : frame.arrays)
    {
      reading.values.push_back(values_of(array, frame.rows));
    }
  }
  catch (const Error& error)
  {
    reading.error = error.what(); // what it says is for a reader to judge
  }
  for (const Notice& notice : notices)
  {
    reading.said += to_string(notice) + "\n";
  }
  return reading;
}

/// Three parts give the same rows. What is wrong in one, or another column in it, is not in all.
inline void check_parts(
  const ByteSource& source, const FrameEntry& entry, Request request, const Reading& whole)
{
  Reading all;
  all.values.resize(whole.values.size());
  request.pieces = 3;
  for (request.piece = 0; request.piece < request.pieces; ++request.piece)
  {
    const Reading part = read_frame(source, entry, request, 2, 100);
    require(whole.error.empty() <= part.error.empty(), "a part of a good frame is wrong");
    if (!part.error.empty() || !(part.schema == whole.schema))
    {
      return;
    }
    for (std::size_t i = 0; i < all.values.size(); ++i)
    {
      all.values[i] += part.values.at(i);
    }
  }
  require(whole.error.empty(), "parts of a frame that is wrong are good");
  require(all.values == whole.values, "parts differ from the whole");
}

/// The same for any number of threads, of a file that is what it was.
inline void check_readings(
  const ByteSource& source, const FrameEntry& entry, const Request& request)
{
  const Reading whole = read_frame(source, entry, request, 1, std::size_t{ 1 } << 18);
  require(read_frame(source, entry, request, 3, 16) == whole, "threads differ");
  check_parts(source, entry, request, whole);
}

/// Of a file that changed since.
inline void check_changed(const ByteSource& source, const FrameEntry& entry, const Request& request)
{
  require(read_frame(source, entry, request, 1, 64) == read_frame(source, entry, request, 3, 64),
    "threads differ");
}

inline std::vector<Request> requests()
{
  std::vector<Request> all(4);
  all[1].wanted = [](std::string_view, bool) { return true; };
  all[1].coordinates = Coordinates::Scaled;
  all[1].stride = 3;
  all[1].sort_by_id = true;
  all[2].coordinates = Coordinates::Unwrapped;
  all[2].single_precision = true;
  all[2].region = { -0.5, 0.5, 1, -1, 1, -1 };
  all[2].point_origin = { 1, 2, 3 };
  all[3].wanted = [](std::string_view, bool) { return false; };
  all[3].sort_by_id = true;
  return all;
}
}
#endif
