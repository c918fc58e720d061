// SPDX-License-Identifier: BSD-3-Clause
#include "dump_frame.h"

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
}

granular::FrameIndex index_of(
  const std::vector<std::string>& files, const granular::IndexOptions& options)
{
  granular::FrameIndex index;
  granular::Notices notices;
  granular::Progress progress;
  index.update(files, options, notices, progress);
  expect_none(notices);
  return index;
}

granular::DumpFrame read_frame(const granular::FrameIndex& index, std::size_t frame)
{
  granular::Notices notices;
  granular::Progress progress;
  granular::DumpFrame read = granular::read_dump(index.pieces(frame), {}, notices, progress);
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

bool holds(const granular::DumpFrame& frame, const Output& truth, std::int64_t truth_rows,
  std::size_t points_at)
{
  std::vector<const void*> data;
  for (const granular::DumpArray& array : frame.arrays)
  {
    data.push_back(array.block.data());
  }
  if (data.size() + 1 != truth.arrays() || frame.rows % truth_rows != 0 || frame.rows == 0)
  {
    return false;
  }
  data.insert(data.begin() + static_cast<std::ptrdiff_t>(points_at), frame.points.data());
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
