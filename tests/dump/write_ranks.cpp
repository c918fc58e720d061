// SPDX-License-Identifier: BSD-3-Clause
// The same bytes from one process and from ranks, with any number of threads, gathered or each for itself.
#include "../support/byte_source_packing.h"
#include "../support/dump_writing.h"
#include "../support/dumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace
{
using namespace granular;

using Shares = std::vector<std::int64_t>;

struct Way
{
  ParallelMode mode;
  int threads;
};
constexpr Way ways[] = { { ParallelMode::Gather, 1 }, { ParallelMode::Gather, 2 },
  { ParallelMode::MpiIo, 1 }, { ParallelMode::MpiIo, 2 } };

/// The bytes of one process must come of all shares, each in two ways that differ in both.
void expect_same(const Frames& frames, const DumpFormat& format, const std::vector<Shares>& all,
  const std::string& what)
{
  const Folder folder;
  const Written expected = write_dump(folder.path("alone"), frames, format);
  ASSERT_EQ(expected.error, "") << what;
  ASSERT_NE(expected.bytes, "");
  static std::size_t turn = 0;
  for (const Shares& shares : all)
  {
    const std::vector<Frames> ranks = cut(frames, shares);
    const std::size_t first = turn++ % 2;
    for (const Way& way : { ways[first], ways[3 - first] })
    {
      const Written written =
        write_dump(folder.path("ranks"), ranks, format, { way.mode, way.threads });
      EXPECT_EQ(written.error, "");
      EXPECT_EQ(written.said, expected.said);
      EXPECT_EQ(difference(written.bytes, expected.bytes), "")
        << what << ": " << shares.size() << " ranks, the first with " << shares[0] << ", mode "
        << static_cast<int>(way.mode) << ", threads " << way.threads;
    }
  }
  EXPECT_EQ(names_in(folder.path("")), "alone ranks");
}

/// Shares of 20000 rows; ranks with none first, in the middle and last.
const std::vector<Shares> some_shares = { { 1 }, { 7000, 1 }, { 12345, 0, 1 }, { 0, 9001, 1 },
  { 1, 19998, 1 }, { 20000, 0, 0 }, { knows_nothing, 1, knows_nothing }, { 1, knows_nothing, 1 },
  { knows_nothing, knows_nothing, 1 } };
const std::vector<Shares> few_shares = { { 1 }, { 0, 9001, 1 }, { 12345, 1, knows_nothing } };
}

TEST(WriteRanks, all_forms)
{
  for (const Form& form : all_forms())
  {
    const MadeRows rows(9000, small_box(form.tilted)); // two chunks of values and more
    expect_same({ rows.view() }, atom_format(form, Dialect::Lammps),
      { { 1 }, { 1, 1 }, { 3001, 3003, 1 }, { 0, 5000, knows_nothing } }, form.name());
  }
}

/// Several frames of other lengths, all columns, words of different lengths.
TEST(WriteRanks, frames)
{
  const MadeRows one(20000, small_box(false), 1);
  const MadeRows two(333, small_box(true), 2);
  const MadeRows three(0, small_box(false), 3);
  Frames frames = { one.view(), two.view(), three.view(), one.view() };
  frames[1].header.timestep = 200;
  frames[2].header.timestep = 300;
  frames[3].header.timestep = 400;
  for (const Dialect dialect : { Dialect::Liggghts, Dialect::Lammps })
  {
    DumpFormat format;
    format.dialect = dialect;
    expect_same(frames, format, dialect == Dialect::Lammps ? some_shares : few_shares, "text");
    format.binary = true;
    format.columns = { "id", "type", "x", "y", "z", "v", "xsu", "image", "element" };
    expect_same(frames, format, few_shares, "binary");
    format.chunk_values = 12345;
    expect_same(frames, format, few_shares, "chunks");
  }
}

TEST(WriteRanks, no_rows)
{
  const MadeRows none(0, small_box(true));
  const std::vector<Shares> shares = { { 1 }, { 0, 0, 0 }, { 0, knows_nothing, knows_nothing },
    { knows_nothing, 0, knows_nothing } };
  for (const bool binary : { false, true })
  {
    DumpFormat format;
    format.binary = binary;
    format.columns = binary ? std::vector<std::string>{ "id", "radius" } : format.columns;
    expect_same({ none.view() }, format, shares, "no rows");
  }
}

/// Text that a rank cannot keep while it counts it: more than 16 MiB.
TEST(WriteRanks, much_text)
{
  const MadeRows rows(130000, small_box(true));
  DumpFormat format;
  format.numbers.digits = 17;
  format.columns = { "id", "x", "y", "z", "v", "xs", "element" };
  expect_same({ rows.view() }, format, { { 125000, 1 }, { 1, 1, 1 } }, "much text");
}

TEST(WriteRanks, compressed)
{
  const MadeRows rows(27000, small_box(false));
  Frames frames = { rows.view(), rows.view() };
  frames[1].header.timestep = 200;
  const Folder folder;
  DumpFormat format;
  const Written plain = write_dump(folder.path("plain"), frames, format);
  ASSERT_GT(plain.bytes.size(), std::size_t{ 4 } << 20) << "several members a frame";
  for (const Compression compression : { Compression::Gzip, Compression::Zstd })
  {
    format.compression = compression;
    const Written packed = write_dump(folder.path("packed"), frames, format);
    EXPECT_LT(packed.bytes.size(), plain.bytes.size() / 2);
    EXPECT_TRUE(packing::read_all(*packing::open(packed.bytes)) == plain.bytes);
    const bool gzip = compression == Compression::Gzip;
    expect_same(frames, format, { gzip ? Shares{ 0, 13333, 1 } : Shares{ 5000, 1 } }, "packed");
  }
}

/// A file a rank, each with its own number of atoms; together they are the frame.
TEST(WriteRanks, file_of_each_rank)
{
  const MadeRows rows(20000, small_box(true));
  Frames frames = { rows.view(), rows.view() };
  frames[1].header.timestep = 200;
  const Folder folder;
  for (const bool binary : { false, true })
  {
    DumpFormat format;
    format.binary = binary;
    format.columns = { "id", "type", "xs", "ys", "zs", "radius" };
    const std::vector<Shares> all = { { 1 }, { 9999, 1 }, { 5000, 0, 1 },
      { 5000, 1, knows_nothing } };
    for (const Shares& shares : all)
    {
      const std::vector<Frames> ranks = cut(frames, shares);
      for (const Way& way : { ways[binary ? 1 : 0], ways[binary ? 2 : 3] })
      {
        const Written written =
          write_dump(folder.path("p.%.dump"), ranks, format, { way.mode, way.threads });
        ASSERT_EQ(written.error, "");
        for (std::size_t rank = 0; rank < shares.size(); ++rank)
        {
          Frames own = ranks[rank];
          for (std::size_t i = 0; i < own.size(); ++i)
          {
            own[i].header = frames[i].header; // a rank that knows nothing hears it from others
            own[i].arrays =
              own[i].arrays.empty() ? rows_of(rows.view(), 0, 0).arrays : own[i].arrays;
          }
          const Written alone = write_dump(folder.path("alone"), own, format);
          EXPECT_EQ(difference(bytes_of_file(folder.path("p." + std::to_string(rank) + ".dump")),
                      alone.bytes),
            "")
            << "rank " << rank << " of " << shares.size();
        }
      }
    }
  }
  EXPECT_EQ(names_in(folder.path("")), "alone p.0.dump p.1.dump p.2.dump");
}

/// '*' stands for the step, '%' for the rank; only the first of each, and none in folders.
TEST(WriteRanks, names)
{
  const MadeRows rows(300, small_box(false));
  Frames frames = { rows.view(), rows.view() };
  frames[1].header.timestep = 2500;
  DumpFormat format;
  format.columns = { "id", "x" };
  const Folder folder;
  std::filesystem::create_directories(folder.path("a*b%c"));
  const std::string inside = folder.path("a*b%c/");
  for (const Way& way : ways)
  {
    const WriteOptions options = { way.mode, way.threads };
    const std::vector<Frames> ranks = cut(frames, { 100, 0, 1 });
    EXPECT_EQ(write_dump(inside + "plain", ranks, format, options).error, "");
    EXPECT_EQ(write_dump(inside + "steps_*_*.dump", ranks, format, options).error, "");
    EXPECT_EQ(write_dump(inside + "all%-%.*", ranks, format, options).error, "");
    EXPECT_EQ(names_in(inside),
      "all0-%.100 all0-%.2500 all1-%.100 all1-%.2500 all2-%.100 all2-%.2500 plain "
      "steps_100_*.dump steps_2500_*.dump");
    EXPECT_EQ(
      bytes_of_file(inside + "steps_100_*.dump") + bytes_of_file(inside + "steps_2500_*.dump"),
      bytes_of_file(inside + "plain"));
  }
  // what is done is done, and what is not leaves the old file
  frames[1].arrays = {};
  format.columns = { "id", "radius" };
  const std::string old = bytes_of_file(inside + "steps_2500_*.dump");
  EXPECT_NE(write_dump(inside + "steps_*_*.dump", cut(frames, { 1, 1 }), format).error, "");
  EXPECT_NE(
    bytes_of_file(inside + "steps_100_*.dump").find("ATOMS id radius\n"), std::string::npos);
  EXPECT_EQ(bytes_of_file(inside + "steps_2500_*.dump"), old);
}

/// Ids that are made count on over the ranks, also in files of their own.
TEST(WriteRanks, made_ids)
{
  const MadeRows rows(20000, small_box(false));
  FrameView frame = rows.view();
  frame.arrays.erase(frame.arrays.begin());
  DumpFormat format;
  format.columns = { "id", "x" };
  expect_same({ frame }, format, some_shares, "made ids");
  const Folder folder;
  write_dump(folder.path("%"), cut({ frame }, { 15000, 1 }), format);
  EXPECT_EQ(Dump(bytes_of_file(folder.path("1"))).read(everything()).integers("id").front(), 15001);
}

TEST(WriteRanks, sorted)
{
  const MadeRows fewer(9000, small_box(true));
  for (const Form& form : all_forms())
  {
    if (!form.tilted)
    {
      continue; // sorting knows nothing of the box
    }
    DumpFormat format = atom_format(form, Dialect::Lammps);
    format.sort_by_id = true;
    expect_same({ fewer.view() }, format,
      { { 1 }, { 3000, 1 }, { 0, 4001, 1 }, { 1, knows_nothing, 1 } }, "sorted " + form.name());
  }
  const MadeRows rows(20000, small_box(true));
  DumpFormat format;
  format.sort_by_id = true;
  expect_same({ rows.view() }, format, some_shares, "sorted with all columns");

  // against a permutation by the standard library
  std::vector<std::size_t> order(rows.ids.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t row) { return rows.ids[row]; });
  std::string expected;
  for (const std::size_t row : order)
  {
    expected += std::to_string(rows.ids[row]) + " " + rows.words[row] + " " +
      std::to_string(rows.images[3 * row + 2]) + "\n";
  }
  format.columns = { "id", "element", "iz" };
  const Folder folder;
  const std::string written =
    write_dump(folder.path("a"), cut({ rows.view() }, { 3000, 1, 1 }), format).bytes;
  const std::string head = "ITEM: ATOMS id element iz\n";
  ASSERT_NE(written.find(head), written.npos);
  EXPECT_EQ(difference(written.substr(written.find(head) + head.size()), expected), "");
}

/// A rank without rows gets some, in columns that are made from others.
TEST(WriteRanks, sorted_columns_that_are_made)
{
  MadeRows rows(20000, small_box(false));
  FrameView frame = rows.view();
  std::erase_if(frame.arrays, [](const ArrayView& array) { return array.name == "radius"; });
  frame.arrays.push_back(view_rows("diameter", ValueType::Int32, rows.types.data()));
  DumpFormat format;
  format.sort_by_id = true;
  format.columns = { "id", "radius", "diameter", "x", "xu", "element" };
  expect_same({ frame }, format, some_shares, "made columns");
  format.binary = true;
  expect_same({ frame }, format, { { 0, 1 }, { knows_nothing, 1, 0 } }, "made columns");
}

/// Rows that another rank has, too, are left out, and counted nowhere.
TEST(WriteRanks, ghosts)
{
  const MadeRows rows(20000, small_box(false));
  std::vector<unsigned char> ghosts(20000);
  MadeRows kept(20000, small_box(false));
  std::mt19937 random(7);
  std::size_t left = 0;
  for (std::size_t row = 0; row < ghosts.size(); ++row)
  {
    // in whole batches of rows, and among others; bits that say something else do not count
    const bool out = (row >= 3000 && row < 9000) || random() % 3 == 0;
    ghosts[row] = static_cast<unsigned char>((out ? 1U : 0U) | (random() % 2 == 0 ? 0xf0U : 0U));
    if (!out)
    {
      kept.ids[left] = rows.ids[row];
      kept.types[left] = rows.types[row];
      kept.radii[left] = rows.radii[row];
      kept.words[left] = rows.words[row];
      for (std::size_t k = 0; k < 3; ++k)
      {
        kept.points[3 * left + k] = rows.points[3 * row + k];
        kept.images[3 * left + k] = rows.images[3 * row + k];
        kept.v[3 * left + k] = rows.v[3 * row + k];
      }
      ++left;
    }
  }
  FrameView frame = rows.view();
  frame.ghosts = ghosts.data();
  FrameView without = kept.view();
  without.rows = static_cast<std::int64_t>(left);
  const Folder folder;
  for (const bool binary : { false, true })
  {
    for (const bool sorted : { false, true })
    {
      DumpFormat format;
      format.binary = binary;
      format.sort_by_id = sorted;
      format.chunk_values = 1000;
      const Written expected = write_dump(folder.path("kept"), Frames{ without }, format);
      const Written written = write_dump(folder.path("ghosts"), Frames{ frame }, format);
      EXPECT_EQ(difference(written.bytes, expected.bytes), "") << binary << sorted;
      expect_same({ frame }, format, binary == sorted ? some_shares : few_shares, "ghosts");
    }
  }

  std::fill(ghosts.begin(), ghosts.end(), static_cast<unsigned char>(1));
  expect_same({ frame }, {}, some_shares, "ghosts alone");
  EXPECT_NE(write_dump(folder.path("none"), Frames{ frame }, {}).bytes.find("ATOMS\n0\n"),
    std::string::npos);
}
