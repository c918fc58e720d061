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

/// The points, where the truth has them, and all other arrays.
std::vector<const void*> arrays_of(const granular::DumpFrame& frame)
{
  std::vector<const void*> data;
  for (const granular::DumpArray& array : frame.arrays)
  {
    data.push_back(array.block.data());
  }
  const std::size_t place = std::min<std::size_t>(2, data.size());
  data.insert(data.begin() + static_cast<std::ptrdiff_t>(place), frame.points.data());
  return data;
}

}

granular::RunIndex index_of(const std::vector<std::string>& files)
{
  granular::RunIndex index;
  granular::Notices notices;
  granular::Progress progress;
  index.update(files, { .format = &granular::dump_format() }, notices, progress);
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

bool holds_from(const granular::DumpFrame& frame, const Output& truth, std::int64_t first_row)
{
  const std::vector<const void*> data = arrays_of(frame);
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

bool holds(const granular::DumpFrame& frame, const Output& truth, std::int64_t truth_rows)
{
  const std::vector<const void*> data = arrays_of(frame);
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
