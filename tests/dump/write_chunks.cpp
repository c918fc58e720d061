// SPDX-License-Identifier: BSD-3-Clause
// A binary dump counts the values of a chunk with 32 bits, and the chunks, too: rows go into as few as that allows.
#include "../support/dump_writing.h"
#include "../support/dumps.h"
#include "../support/reference_dump.h"

#include "granular/formats/dump/write/encode_header.h"
#include "granular/formats/dump/write/row_batches.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace
{
using namespace granular;

__extension__ using Wide = __int128;

constexpr std::int64_t edge = std::numeric_limits<std::int32_t>::max(); // 2^31 - 1

/// The lengths of the chunks of the only frame of a binary dump without names, orthogonal.
std::vector<std::int32_t> lengths_in(const std::string& bytes)
{
  const auto number = [&](std::size_t at)
  {
    std::int32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  constexpr std::size_t count_at = 96;
  std::vector<std::int32_t> lengths;
  std::size_t at = count_at + 4;
  for (std::int32_t chunk = 0; chunk < number(count_at); ++chunk)
  {
    lengths.push_back(number(at));
    at += 4 + sizeof(double) * static_cast<std::size_t>(lengths.back());
  }
  EXPECT_EQ(at, bytes.size());
  return lengths;
}

ReferenceBox reference_box()
{
  return { { -1.5, 0, 2 }, { 8.5, 7.75, 10.5 }, 0, 0, 0, false, "pp fs mm" };
}
}

TEST(WriteChunks, fewest)
{
  const MadeRows rows(2600, small_box(false));
  const ReferenceAtoms atoms = { rows.ids, rows.types, rows.points, rows.images };
  const Folder folder;
  for (const bool image : { false, true })
  {
    const std::int64_t size = image ? 8 : 5;
    const std::int64_t values = size * 2600;
    for (const std::int64_t most : { values - size, values - 1, values, values + 1, values / 2 - 1,
           values / 2, size * 7, size * 7 + 4, size, size + 1, size * 1024, size * 1023 + 3 })
    {
      const Form form{ { true, image }, false, true };
      DumpFormat format = atom_format(form, Dialect::Liggghts);
      format.chunk_values = most;
      FrameView frame = rows.view();
      const Written written = write_dump(folder.path("a.bin"), Frames{ frame }, format);
      ASSERT_EQ(written.error, "");
      const std::string expected = reference_dump(reference_box(), atoms,
        { true, image, true, false, static_cast<std::int32_t>(most / size) }, 100);
      EXPECT_EQ(difference(written.bytes, expected), "") << most;
      const std::vector<std::int32_t> lengths = lengths_in(written.bytes);
      const std::int64_t whole = most / size * size;
      EXPECT_EQ(static_cast<std::int64_t>(lengths.size()), (values + whole - 1) / whole);
      for (std::size_t i = 0; i + 1 < lengths.size(); ++i)
      {
        EXPECT_EQ(lengths[i], whole);
      }
      Request request;
      request.coordinates = Coordinates::Scaled;
      const Decoded read =
        Dump(written.bytes, image ? "id type xs ys zs ix iy iz" : "id type xs ys zs").read(request);
      EXPECT_EQ(read.integers("id"), rows.ids);
      if (image)
      {
        EXPECT_EQ(read.integers("image"),
          std::vector<std::int64_t>(rows.images.begin(), rows.images.end()));
      }
    }
  }
}

TEST(WriteChunks, what_does_not_fit)
{
  const MadeRows rows(10, small_box(false));
  DumpFormat format = atom_format({ { true, true }, false, true }, Dialect::Lammps);
  format.chunk_values = 7;
  const Folder folder;
  const Written written = write_dump(folder.path("a.bin"), cut({ rows.view() }, { 3, 1 }), format);
  EXPECT_EQ(written.error, "expected 1 to 7 columns in a binary dump, got 8");
  EXPECT_EQ(names_in(folder.path("")), "");
  EXPECT_EQ(error_of([] { ChunkLengths(1, edge + 1, edge - 1); }),
    "expected 1 to 2147483646 columns in a binary dump, got 2147483648");
  EXPECT_EQ(error_of([] { ChunkLengths(edge, 3, 3); }), "");
  EXPECT_EQ(error_of([] { ChunkLengths(edge + 1, 3, 3); }),
    "expected at most 2147483647 chunks in a binary dump, which counts them with 32 bits, got "
    "2147483648 of 1 rows");
  EXPECT_EQ(error_of([] { ChunkLengths(std::numeric_limits<std::int64_t>::max(), 1, edge - 1); }),
    "expected at most 2147483647 chunks in a binary dump, which counts them with 32 bits, got "
    "4294967301 of 2147483646 rows");
}

/// At the real limit: a chunk has less than 2^31 - 1 values.
TEST(WriteChunks, two_thousand_million_values)
{
  const std::int64_t most = DumpFormat().chunk_values;
  ASSERT_EQ(most, edge - 1);
  for (const std::int64_t size : { 1, 2, 5, 8, 19, 10000 })
  {
    const std::int64_t full = most / size;
    ASSERT_LT(full * size, edge);
    ASSERT_GT((full + 1) * size, edge - 1);
    for (const std::int64_t rows : { std::int64_t{ 0 }, std::int64_t{ 1 }, full - 1, full, full + 1,
           2 * full - 1, 2 * full, 2 * full + 1, std::int64_t{ 10000000000 } })
    {
      const ChunkLengths chunks(rows, size, most);
      const std::int64_t expected = std::max<std::int64_t>(1, (rows + full - 1) / full);
      ASSERT_EQ(chunks.chunks(), expected);
      ASSERT_EQ(chunks.rows_per_chunk(), full);
      Wide values = 0;
      for (std::int64_t chunk = 0; rows > 0 && chunk < expected; ++chunk)
      {
        EXPECT_TRUE(chunks.begins(chunk * full));
        EXPECT_FALSE(chunks.begins(chunk * full + 1) && full > 1);
        EXPECT_GT(chunks.values(chunk * full), 0);
        EXPECT_LT(chunks.values(chunk * full), edge);
        // before the length of this chunk: the lengths and values of those before it
        EXPECT_TRUE(chunks.offset(chunk * full) == Wide(4) * chunk + values * 8);
        EXPECT_TRUE(chunks.offset(chunk * full + 1) == Wide(4) * (chunk + 1) + (values + size) * 8);
        values += chunks.values(chunk * full);
      }
      EXPECT_TRUE(values == Wide(rows) * size);
      EXPECT_TRUE(rows == 0 || chunks.offset(rows) == Wide(4) * expected + values * 8);
    }
  }
}

/// Rows of a rank far behind the first, beside the end of a chunk that no test has memory for.
TEST(WriteChunks, rows_far_behind)
{
  const MadeRows made(3000, small_box(false));
  const FrameView frame = made.view();
  const DumpFormat format = atom_format({ { false, false }, false, true }, Dialect::Lammps);
  Notices notices;
  const ColumnPlan plan = plan_columns(atom_columns(format.atom), frame, true, notices);
  const std::int64_t full = (edge - 1) / 5;
  const std::int64_t all = 3 * full;
  const ChunkLengths chunks(all, 5, format.chunk_values);
  for (const std::int64_t first :
    { full - 1, full - 1024, full - 1025, full - 1500, full, 2 * full - 7, 2 * full - 2999 })
  {
    const RowsToEncode rows{ frame, plan, made.box, format, chunks, first, first };
    const Executor executor(2);
    RowBatches batches(rows, executor);
    Progress progress;
    std::string bytes;
    while (batches.next(progress))
    {
      for (const std::string_view part : batches.bytes())
      {
        bytes += part;
      }
    }
    EXPECT_EQ(
      static_cast<std::int64_t>(bytes.size()), chunks.offset(first + 3000) - chunks.offset(first));
    // the length stands before the row that begins a chunk, in 4 bytes
    const std::int64_t before = (first + full - 1) / full * full - first;
    std::int32_t length = 0;
    std::memcpy(&length, bytes.data() + before * 40, sizeof length);
    EXPECT_EQ(length, full * 5);
    bytes.erase(static_cast<std::size_t>(before) * 40, 4);
    double id = 0;
    for (std::size_t row = 0; row < 3000; ++row)
    {
      std::memcpy(&id, bytes.data() + row * 40, sizeof id);
      ASSERT_EQ(id, static_cast<double>(made.ids[row]));
    }
  }
}
