// SPDX-License-Identifier: BSD-3-Clause
// Frames of more than 2^31 values and files of more than 4 GiB: sparse files, whose holes read as
// zeros.
#include "../support/binary_dumps.h"
#include "../support/dumps.h"
#include "../support/resident_memory.h"
#include "../support/series.h"
#include "../support/sparse_file.h"
#include "../support/stop.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace
{
using binary::Form;
using binary::Frame;

void expect_small_frame(const Series& run, std::size_t number, const Frame& frame)
{
  const Decoded got = run.read(number);
  EXPECT_EQ(got.said(), "");
  EXPECT_EQ(got.rows(), frame.rows());
  EXPECT_EQ(got.values("id"), frame.values(0));
  EXPECT_EQ(got.values("radius"), frame.values(11));
}
}

TEST(BinaryLarge, TrapMoreValuesThan31Bits)
{
  for (const char* const name : { "plain, little-endian", "DUMPCUSTOM revision 2, big-endian" })
  {
    SCOPED_TRACE(name);
    const Form& form = binary::form(name);
    const Folder folder;
    SparseFile file(folder.path("large.bin"));
    // 2.4e9 values, in chunks of the largest number that fits an int32, of none, and of the rest
    constexpr std::int64_t chunk = 2147483647 / 12;
    const Frame first = binary::particles(form, 0, 3);
    const Frame second = binary::particles(form, 2, 4);
    file.append(binary::write(form, { first }).bytes);
    const std::int64_t large_offset = file.size();
    const std::int64_t rows =
      append_large(file, form, binary::particles(form, 1, 1), { chunk, 0, 21045513 });
    const std::int64_t large_end = file.size();
    file.append(binary::write(form, { second }).bytes);
    if (!file.good())
    {
      GTEST_SKIP() << "the file system has no sparse files of this size: " << std::strerror(errno);
    }
    ASSERT_GT(12 * rows, std::int64_t{ 1 } << 31);
    ASSERT_GT(large_end, std::int64_t{ 1 } << 34);

    Series run;
    run.options.column_names = { "id", "type", "x", "y", "z", "ix", "iy", "iz", "vx", "vy", "vz",
      "radius" };
    run.update({ file.path() });
    EXPECT_EQ(run.said, "");
    ASSERT_EQ(run.index.size(), 3u);
    const granular::FrameEntry entry = run.entry(1);
    EXPECT_EQ(entry.rows, rows);
    EXPECT_EQ(entry.offset, large_offset);
    EXPECT_EQ(entry.end, large_end);
    EXPECT_EQ(run.entry(2).offset, large_end);
    expect_small_frame(run, 0, first);
    expect_small_frame(run, 2, second);

    // it grows, and only what is new is looked at
    const Frame third = binary::particles(form, 3, 2);
    const std::string more = binary::write(form, { third }).bytes;
    file.append(more);
    run.update({ file.path() });
    ASSERT_EQ(run.index.size(), 4u);
    expect_small_frame(run, 3, third);
  }
}

// Memory is for the rows that are read, not for those that are said to be there.
TEST(BinaryLarge, ReadingTakesMemoryAsItGoes)
{
  const Form& form = binary::form("plain, big-endian");
  const Folder folder;
  SparseFile file(folder.path("large.bin"));
  Frame wide;
  wide.size_one = 5000;
  wide.chunks = { std::vector<double>(5000, 1) };
  const std::int64_t rows = append_large(file, form, wide, { 400000, 40000 });
  if (!file.good())
  {
    GTEST_SKIP() << "the file system has no sparse files of this size: " << std::strerror(errno);
  }
  ASSERT_GT(5000 * rows, std::int64_t{ 1 } << 31);
  Series run;
  run.options.column_names = { "id", "x", "y", "z" };
  for (int i = 5; i <= 5000; ++i)
  {
    run.options.column_names.push_back("c" + std::to_string(i));
  }
  run.update({ file.path() });
  ASSERT_EQ(run.index.size(), 1u);
  EXPECT_EQ(run.entry(0).rows, rows);

  const std::int64_t before = restart_peak();
  granular::Request request;
  request.stride = 1 << 30;
  request.wanted = [](std::string_view, bool) { return false; };
  Stop stop(3);
  granular::Notices notices;
  EXPECT_THROW(read_dump(run.index.pieces(0), request, notices, stop), granular::Cancelled);
  EXPECT_GT(stop.last, 0);
  EXPECT_LT(stop.last, 0.1);
  EXPECT_LT(peak_bytes() - before, std::int64_t{ 1 } << 28);
}
