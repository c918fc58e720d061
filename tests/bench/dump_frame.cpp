// SPDX-License-Identifier: BSD-3-Clause
#include "dump_frame.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace bench
{
namespace
{
void expect_none(const granular::Notices& notices)
{
  if (!notices.empty())
  {
    throw std::logic_error("the benchmark's own dump is wrong: " + notices.front().text);
  }
}

/// The points where the truth has them, and all other arrays.
std::vector<const void*> arrays_of(const granular::DumpFrame& frame, std::size_t points_at)
{
  std::vector<const void*> data;
  for (const granular::DumpArray& array : frame.arrays)
  {
    data.push_back(array.block.data());
  }
  const std::size_t place = std::min(points_at, data.size());
  data.insert(data.begin() + static_cast<std::ptrdiff_t>(place), frame.points.data());
  return data;
}

template <typename T>
void put(std::string& bytes, T value)
{
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof raw);
}

void put_text(std::string& bytes, const std::string& text)
{
  put(bytes, static_cast<std::int32_t>(text.size()));
  bytes += text;
}

/// What `dump custom` of LAMMPS writes before the chunks.
std::string binary_header(const Rows& form, std::int32_t chunks)
{
  const std::string magic = "DUMPCUSTOM";
  std::string bytes;
  put(bytes, -static_cast<std::int64_t>(magic.size()));
  bytes += magic;
  put(bytes, std::int32_t{ 1 }); // the byte order
  put(bytes, std::int32_t{ 2 }); // the revision
  put(bytes, std::int64_t{ 0 }); // the timestep
  put(bytes, form.count);
  for (int i = 0; i < 7; ++i)
  {
    put(bytes, std::int32_t{ 0 }); // not triclinic, periodic
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    put(bytes, 0.0);
    put(bytes, 1.0);
  }
  put(bytes, static_cast<std::int32_t>(form.words()));
  put_text(bytes, ""); // units
  bytes += '\0';       // no time
  put_text(bytes, form.columns);
  put(bytes, chunks);
  return bytes;
}
}

granular::RunIndex index_of(
  const std::vector<std::string>& files, const granular::IndexOptions& options)
{
  granular::RunIndex index;
  granular::Notices notices;
  granular::Progress progress;
  index.update(files, options, notices, progress);
  expect_none(notices);
  return index;
}

granular::DumpFrame read_frame(
  const granular::RunIndex& index, std::size_t frame, const granular::DumpRequest& request)
{
  granular::Notices notices;
  granular::Progress progress;
  granular::DumpFrame read = granular::read_dump(index.pieces(frame), request, notices, progress);
  expect_none(notices);
  return read;
}

granular::DumpFrame read_frame(
  const granular::ByteSource& source, const granular::FrameEntry& entry)
{
  granular::Notices notices;
  granular::Progress progress;
  granular::DumpFrame read = granular::read_dump(source, entry, {}, notices, progress);
  expect_none(notices);
  return read;
}

TextFrame::TextFrame(Form form, std::int64_t row_count)
  : rows(make_rows(form, std::min(row_count, most_distinct_rows)))
  , truth(rows, rows.count)
  , count(row_count)
{
  write_frame(file, rows, count);
  index = index_of({ file.path() });
  std::vector<granular::ColumnSink> sinks = truth.sinks(0);
  if (!parse_slowly(rows.text.c_str(), sinks, rows.count))
  {
    throw std::logic_error("the benchmark's own text is wrong");
  }
}

BinaryFrame::BinaryFrame(const Rows& rows, std::int64_t rows_a_chunk)
  : form(rows)
  , truth(rows, rows.count)
{
  this->make_values();
  const std::int64_t chunks = (form.count + rows_a_chunk - 1) / rows_a_chunk;
  bytes = binary_header(form, static_cast<std::int32_t>(chunks));
  for (std::int64_t row = 0; row < form.count; row += rows_a_chunk)
  {
    const auto n =
      static_cast<std::size_t>(std::min(rows_a_chunk, form.count - row)) * form.words();
    put(bytes, static_cast<std::int32_t>(n));
    const double* const from = values.data() + static_cast<std::size_t>(row) * form.words();
    bytes.append(reinterpret_cast<const char*>(from), n * sizeof(double));
  }
  file.append(bytes);
  index = index_of({ file.path() });
}

void BinaryFrame::make_values()
{
  Random random(1);
  std::vector<granular::ColumnSink> sinks = truth.sinks(0);
  for (std::int64_t row = 0; row < form.count; ++row)
  {
    for (granular::ColumnSink& sink : sinks)
    {
      const auto number = static_cast<std::int32_t>(1 + random.bits() % 1'000'000);
      const std::int64_t wide = number;
      const double value = random.between(-1, 1);
      const void* const source = sink.type == ValueType::Float64 ? static_cast<const void*>(&value)
        : sink.type == ValueType::Int32                          ? &number
                                                                 : static_cast<const void*>(&wide);
      std::memcpy(sink.data, source, granular::size_of(sink.type));
      sink.data += sink.stride;
      values.push_back(sink.type == ValueType::Float64 ? value : number);
    }
  }
}

bool holds_from(const granular::DumpFrame& frame, const Output& truth, std::int64_t first_row)
{
  const std::vector<const void*> data = arrays_of(frame, 2);
  bool right = data.size() == truth.arrays();
  for (std::size_t i = 0; i < data.size() && right; ++i)
  {
    const std::size_t bytes = truth.bytes_a_row(i);
    right = frame.rows == 0 ||
      std::memcmp(data[i], truth.array(i) + static_cast<std::size_t>(first_row) * bytes,
        static_cast<std::size_t>(frame.rows) * bytes) == 0;
  }
  return right;
}

bool holds(const granular::DumpFrame& frame, const Output& truth, std::int64_t truth_rows,
  std::size_t points_at)
{
  const std::vector<const void*> data = arrays_of(frame, points_at);
  if (data.size() != truth.arrays() || frame.rows % truth_rows != 0 || frame.rows == 0)
  {
    return false;
  }
  for (std::size_t i = 0; i < data.size(); ++i)
  {
    const std::size_t bytes = truth.bytes_a_row(i) * static_cast<std::size_t>(truth_rows);
    const auto* from = static_cast<const char*>(data[i]);
    for (std::int64_t row = 0; row < frame.rows; row += truth_rows, from += bytes)
    {
      if (std::memcmp(from, truth.array(i), bytes) != 0)
      {
        return false;
      }
    }
  }
  return true;
}
}
