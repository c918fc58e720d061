// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_source.h"

#include "../support/byte_source_packing.h"
#include "granular/common/error.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include <zlib.h>

namespace
{
using granular::SeekPoints;
using packing::expect_content;
using packing::gzip;
using packing::open;
using packing::Outcomes;
using packing::read_all;
using packing::rows;
using packing::spaced;

/// With each library that there is.
class Gzip : public testing::TestWithParam<granular::Inflation>
{
protected:
  void SetUp() override { packing::inflation = &GetParam(); }
  void TearDown() override { packing::inflation = nullptr; }
};

INSTANTIATE_TEST_SUITE_P(By, Gzip, testing::ValuesIn(granular::inflations()),
  [](const auto& param) { return std::string(param.param.name); });

constexpr const char* cut_text =
  "expected the end of the gzip data, got the end of the file; what is there is taken unchecked";
}

// Written by LAMMPS; zlib itself says what is inside.
TEST_P(Gzip, OfLammps)
{
  const std::string path = std::string(GRANULAR_DATA) + "/good/ortho_000000.dump.gz";
  std::string expected(1 << 20, '\0');
  gzFile file = gzopen(path.c_str(), "rb");
  ASSERT_NE(file, nullptr);
  const int got = gzread(file, expected.data(), static_cast<unsigned>(expected.size()));
  gzclose(file);
  ASSERT_GT(got, 0);
  expected.resize(static_cast<std::size_t>(got));
  ASSERT_EQ(expected.rfind("ITEM: TIMESTEP\n", 0), 0u);

  const auto source = packing::unpack(granular::open_file(path));
  EXPECT_EQ(source->path(), path);
  EXPECT_EQ(read_all(*source), expected);
  EXPECT_EQ(source->unchecked(), "");
  EXPECT_EQ(source->stamp(), granular::open_file(path)->stamp());
}

TEST_P(Gzip, EveryLevel)
{
  const std::string content = rows(700000);
  for (const int level : { 0, 1, 6, 9 })
  {
    expect_content(gzip(content, { level }), content);
  }
  expect_content(gzip(content, { 1, Z_FIXED }), content);
  expect_content(gzip(content, { 1, Z_HUFFMAN_ONLY }), content);
  expect_content(gzip(content, { 1, Z_RLE }), content);
}

TEST_P(Gzip, Empty)
{
  expect_content(gzip(""), "");
  expect_content(gzip("") + gzip(""), "");
}

TEST_P(Gzip, Members)
{
  const std::string a = rows(1000, 1), b = rows(300000, 2);
  expect_content(gzip("") + gzip(a) + gzip("") + gzip("") + gzip(b, { 0 }) + gzip(""), a + b);
}

TEST_P(Gzip, AllFieldsOfTheHeader)
{
  const std::string content = rows(5000);
  const std::string packed = gzip(content, { 6, 0, true });
  ASSERT_EQ(packed[3], 0x1f); // all flags
  expect_content(packed, content);
  expect_content(gzip("x") + packed, "x" + content);
}

// Longer than the buffer that the file is read through.
TEST_P(Gzip, LongName)
{
  std::string packed = gzip("content");
  packed[3] = 8;
  packed.insert(10, std::string(600000, 'n') + '\0');
  expect_content(packed, "content");
}

TEST_P(Gzip, ZerosBehind)
{
  const std::string content = rows(1000);
  expect_content(gzip(content) + std::string(1, '\0'), content);
  expect_content(gzip(content) + std::string(1000000, '\0'), content);
  expect_content(gzip(content) + std::string(511, '\0') + gzip(content), content + content);
}

TEST_P(Gzip, OtherBytesBehind)
{
  const std::string packed = gzip("content");
  for (const std::string behind : { "x", "\n", "\x1f\x8c", "ITEM: TIMESTEP\n", "\x28\xb5\x2f\xfd" })
  {
    EXPECT_EQ(packing::error_of(packed + behind),
      "packed@" + std::to_string(packed.size()) +
        ": expected the end of the gzip data or more of them, got other bytes");
  }
  EXPECT_NE(packing::error_of(packed + std::string(3, '\0') + "x"), "");
}

TEST_P(Gzip, CutAnywhere)
{
  const std::string a = rows(300, 1), b = rows(200, 2);
  const std::string first = gzip(a, { 6, 0, true });
  const std::string packed = first + gzip(b, { 9 });
  packing::expect_prefixes(packed, a + b,
    [&](std::size_t length) { return length == first.size() || length == packed.size(); });
  const auto source = open(std::string_view(packed).substr(0, packed.size() - 1));
  EXPECT_EQ(read_all(*source), a + b);
  EXPECT_EQ(source->unchecked(), cut_text);
}

// What is only not there yet must not pass for damage.
TEST_P(Gzip, CutAnywhereInAnyKind)
{
  const std::string content = rows(400) + std::string(600, 'x') + rows(300, 2) + "\x80\xff\x01\n";
  std::size_t turn = 0; // any two of strategy, level and length of the blocks together
  for (const int strategy : { Z_DEFAULT_STRATEGY, Z_FILTERED, Z_HUFFMAN_ONLY, Z_RLE, Z_FIXED })
  {
    for (const int level : { 0, 1, 4, 9 })
    {
      const std::string packed = gzip(content, { level, strategy, false, turn++ % 3 * 37 });
      std::size_t last = 0;
      for (std::size_t length = 3; length < packed.size(); ++length)
      {
        const auto source = open(std::string_view(packed).substr(0, length));
        const std::string text = read_all(*source);
        ASSERT_EQ(text, content.substr(0, text.size())) << length;
        ASSERT_EQ(source->unchecked(), cut_text) << length;
        ASSERT_GE(text.size(), last) << length;
        last = text.size();
      }
      ASSERT_GE(last + 3, content.size()) << "all but the sum is there";
    }
  }
}

/// A CRC that is there counts, also where the file ends before the size.
TEST_P(Gzip, DamagedAndCut)
{
  std::string packed = gzip(rows(1000));
  packed[packed.size() - 5] ^= 1;
  for (const std::size_t less : { 0u, 1u, 4u })
  {
    EXPECT_NE(packing::error_of(packed.substr(0, packed.size() - less)), "") << less;
  }
  EXPECT_EQ(packing::error_of(packed.substr(0, packed.size() - 5)), "");
}

// Ends of blocks, and the end of the file anywhere near them.
TEST_P(Gzip, CutBetweenBlocks)
{
  const std::string content = rows(3000);
  const std::string packed = gzip(content, { 6, 0, false, 300 });
  for (std::size_t length = 20; length < packed.size(); ++length)
  {
    const auto source = open(std::string_view(packed).substr(0, length), spaced(1));
    const std::string text = read_all(*source);
    EXPECT_EQ(text, content.substr(0, text.size())) << length;
    EXPECT_EQ(source->unchecked(), cut_text) << length;
    const auto whole = open(std::string_view(packed).substr(0, length), spaced(1 << 20));
    EXPECT_EQ(read_all(*whole), text) << length;
  }
}

TEST_P(Gzip, EveryByteDamaged)
{
  const std::string a = rows(200, 1), b = rows(100, 2);
  const std::string packed = gzip(a, { 6, 0, true }) + gzip(b, { 0 });
  const Outcomes outcomes = packing::damage(packed, a + b);
  EXPECT_EQ(outcomes.silent, 0);
  EXPECT_LE(outcomes.plain, 3 * 5); // the first three bytes
  EXPECT_GT(outcomes.plain, 0);
  EXPECT_LE(outcomes.exact, 12 * 5); // time, system and kind of compression of the second header
  EXPECT_GT(outcomes.exact, 0);
  EXPECT_GT(outcomes.refused, 4 * static_cast<int>(packed.size() - 20));
}

TEST_P(Gzip, EveryByteDamagedBetweenManyBlocks)
{
  const std::string content = rows(600);
  const Outcomes outcomes = packing::damage(gzip(content, { 6, 0, false, 100 }), content);
  EXPECT_EQ(outcomes.silent, 0);
  EXPECT_GT(outcomes.refused, 1000);
}

TEST_P(Gzip, SaysWhatIsDamaged)
{
  const std::string content = rows(1000);
  std::string packed = gzip(content);
  const std::string trailer = std::to_string(packed.size() - 8);
  std::string other = packed;
  other[packed.size() - 5] ^= 1;
  EXPECT_EQ(packing::error_of(other).rfind(
              "packed@" + trailer + ": expected gzip data with the CRC-32 0x", 0),
    0u)
    << packing::error_of(other);
  other = packed;
  other[packed.size() - 4] ^= 1;
  EXPECT_EQ(packing::error_of(other),
    "packed@" + trailer + ": expected gzip data of 1001 bytes modulo 2^32, got 1000");
  other = packed;
  other[3] = '\x40';
  EXPECT_EQ(packing::error_of(other),
    "packed@0: expected a gzip header, got flags that are not defined (0x40)");
  other = gzip(content, { 6, 0, true });
  other[4] ^= 1;
  EXPECT_EQ(
    packing::error_of(other), "packed@0: expected a gzip header that fits its CRC, got another");
  other = packed;
  other[10] = '\xff'; // a block of the kind that does not exist
  const std::string error = packing::error_of(other);
  EXPECT_EQ(error.rfind("packed@11: expected gzip data, got bytes that are none (invalid ", 0), 0u)
    << error;
}

TEST_P(Gzip, ThrowsAgain)
{
  const std::string content = rows(3 << 20);
  std::string packed = gzip(content, { 1 });
  packed[packed.size() / 2] ^= 0x10;
  EXPECT_GE(packing::expect_same_error(packed), static_cast<std::int64_t>(packed.size() / 2));
}

TEST_P(Gzip, RandomReads)
{
  const std::string content = rows(6 << 20, 5);
  packing::Medium medium{ gzip(content, { 1 }) };
  const auto points = packing::expect_points_to_serve(medium, content, 11);
  const std::size_t found = points->points.size();
  EXPECT_GT(found, 20u);
  EXPECT_LE(found, 48u);
  EXPECT_GT(points->bytes(), found << 15);
  EXPECT_LT(points->bytes(), (found << 15) + (found << 8));
}

TEST_P(Gzip, RandomReadsOfManyMembers)
{
  std::string content, packed;
  for (unsigned i = 0; i < 400; ++i)
  {
    const std::string part = rows(i % 7 == 0 ? 0 : i * 31, i);
    content += part;
    packed += gzip(part, { static_cast<int>(i % 10) });
  }
  const auto points = spaced(20000);
  packing::expect_random_reads(*open(packed, points), content, 300, 13);
  packing::expect_random_reads(*open(packed, points), content, 300, 14);
  EXPECT_GT(points->points.size(), 50u);
  for (const SeekPoints::Point& point : points->points)
  {
    EXPECT_TRUE(!point.window.empty() ||
      packed.compare(static_cast<std::size_t>(point.packed), 3, "\x1f\x8b\x08") == 0);
  }
}

// What a point carries is enough to check the whole member from there on.
TEST_P(Gzip, ChecksFromTheMiddle)
{
  const std::string content = rows(2 << 20);
  packing::Medium medium{ gzip(content, { 1 }) };
  const auto points = spaced(1 << 18);
  EXPECT_TRUE(read_all(*packing::unpack(packing::open_medium(medium), points)) == content);
  for (const std::size_t from_end : { 1u, 5u }) // size and CRC
  {
    packing::Medium damaged = medium;
    damaged.bytes[damaged.bytes.size() - from_end] ^= 1;
    damaged.read = 0;
    const auto source = packing::unpack(packing::open_medium(damaged), points);
    EXPECT_THROW(read_all(*source, 1000, (2 << 20) - 1500), granular::FormatError);
    EXPECT_LT(damaged.read, 400000);
  }
}

TEST_P(Gzip, PointsOfAnotherFile)
{
  const auto points = spaced(1 << 17);
  read_all(*open(gzip(rows(1 << 20, 1), { 1 }), points));
  ASSERT_GT(points->points.size(), 4u);
  const std::string other = gzip(rows(1 << 20, 2), { 2 });
  EXPECT_THROW(read_all(*open(other, points), 1000, 900000), granular::FormatError);
  const std::string shorter = gzip("short");
  const auto source = open(shorter, points);
  EXPECT_EQ(read_all(*source, 1000, 900000), "");
  EXPECT_EQ(source->unchecked(), cut_text);
}

TEST_P(Gzip, GrowsBetweenTwoSources)
{
  const std::string content = rows(3 << 20);
  packing::expect_growth_between_sources(
    gzip(content.substr(0, 2 << 20), { 1 }) + gzip(content.substr(2 << 20)), content, cut_text);
}

TEST_P(Gzip, GrowsWhileOpen)
{
  const std::string content = rows(5000);
  packing::expect_growth_while_open(
    gzip(content.substr(0, 3000), { 6, 0, true }) + gzip(content.substr(3000), { 6, 0, true }),
    content);
}

/// Readers of an index that is finished add nothing to it, wherever they stop.
TEST_P(Gzip, KnownPointsStayAsTheyAre)
{
  const std::string content = rows(4 << 20, 3);
  const std::string packed = gzip(content, { 1 });
  const auto points = spaced(1 << 18);
  EXPECT_TRUE(read_all(*open(packed, points)) == content);
  const SeekPoints before = *points;
  points->points.resize(points->points.size() / 2); // others are due
  for (const std::size_t piece : { 100u, 4097u, 300'000u })
  {
    const auto source = granular::unpack_known(granular::open_memory(packed), points);
    EXPECT_TRUE(read_all(*source, piece) == content);
    EXPECT_EQ(points->points.size(), before.points.size() / 2);
  }
}

/// One block for all of the content, or many whose beginnings nobody sees: the search for them must end.
TEST_P(Gzip, EndlessBlocks)
{
  const std::string content = rows(4 << 20, 4);
  for (const std::string& packed :
    { gzip(content, { 1, Z_FIXED }), gzip(content, { 1, Z_FIXED, false, 1'500'000 }) })
  {
    const auto points = spaced(1 << 18);
    const auto source = open(packed, points);
    EXPECT_TRUE(read_all(*source) == content);
    packing::expect_random_reads(*open(packed, points), content, 20, 18);
  }
}

// zlib ends a block after 16 thousand words: each of these stands for 258 bytes.
TEST_P(Gzip, LongBlocks)
{
  const std::string content(20 << 20, 'z');
  const auto points = spaced(1 << 16);
  const std::string packed = gzip(content);
  const auto source = open(packed, points);
  EXPECT_TRUE(read_all(*source) == content);
  EXPECT_GE(points->points.size(), 2u);
  EXPECT_LE(points->points.size(), 6u);
  packing::expect_random_reads(*source, content, 30, 15);
}

TEST(GzipPoints, OfOneLibraryServeTheOthers)
{
  const std::string content = rows(3 << 20, 5);
  const std::string packed =
    gzip(content.substr(0, 1 << 20)) + gzip(content.substr(1 << 20), { 1 });
  for (const granular::Inflation& finds : granular::inflations())
  {
    const auto points = spaced(1 << 16);
    packing::inflation = &finds;
    EXPECT_TRUE(read_all(*open(packed, points)) == content);
    EXPECT_GT(points->points.size(), 20u) << finds.name;
    for (const granular::Inflation& uses : granular::inflations())
    {
      packing::inflation = &uses;
      packing::expect_random_reads(*open(packed, points), content, 150, 17);
    }
  }
  packing::inflation = nullptr;
}

// zlib gives what it is asked for; others go ahead of it, past ends of blocks.
TEST(GzipPoints, ManyPointsAreThinned)
{
  packing::inflation = &granular::inflations().back();
  const std::string content = rows(3 << 20);
  const std::string packed = gzip(content, { 1, 0, false, 1000 });
  const auto points = spaced(1000);
  EXPECT_TRUE(read_all(*open(packed, points)) == content);
  EXPECT_LE(points->points.size(), 1024u);
  EXPECT_GE(points->points.size(), 500u);
  EXPECT_EQ(points->spacing, 4000);
  std::int64_t last = 0;
  for (const SeekPoints::Point& point : points->points)
  {
    EXPECT_GE(point.offset - last, 4000);
    EXPECT_LE(point.offset - last, 8000);
    last = point.offset;
  }
  packing::expect_random_reads(*open(packed, points), content, 200, 16);
  packing::inflation = nullptr;
}
