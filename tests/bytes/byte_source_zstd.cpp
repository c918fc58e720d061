// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_source.h"

#include "../support/byte_source_packing.h"
#include "granular/common/error.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace
{
using granular::SeekPoints;
using packing::expect_content;
using packing::open;
using packing::Outcomes;
using packing::read_all;
using packing::rows;
using packing::spaced;
using packing::zstd;
using packing::zstd_skippable;

constexpr const char* cut_text =
  "expected the end of the zstd data, got the end of the file; what is there is taken unchecked";

/// A frame of three bytes as RFC 8878 describes it: no checksum, one raw block, its size if asked for. Its window
/// is 2^(10 + exponent) and mantissa eighths of that.
std::string frame_with_window(int exponent, int mantissa, bool sized = false)
{
  return std::string("\x28\xb5\x2f\xfd") + static_cast<char>(sized ? 2 << 6 : 0) +
    static_cast<char>(exponent << 3 | mantissa) +
    (sized ? std::string("\x03\0\0\0", 4) : std::string()) + std::string("\x19\0\0abc", 6);
}

/// The window of such a frame is its content.
std::string frame_of_one_segment(std::uint32_t content)
{
  std::string frame = "\x28\xb5\x2f\xfd\xa0";
  for (int byte = 0; byte < 4; ++byte)
  {
    frame += static_cast<char>(content >> 8 * byte & 0xff);
  }
  return frame + std::string("\x19\0\0abc", 6);
}
}

TEST(Zstd, EveryLevel)
{
  const std::string content = rows(1500000);
  for (const int level : { -5, 1, 3, 9 })
  {
    expect_content(zstd(content, { level }), content);
  }
  expect_content(zstd(content, { 1, false, true }), content);
  expect_content(zstd(content, { 1, false, false }), content);
  expect_content(zstd(content, { 1, true, false }), content);
}

TEST(Zstd, Empty)
{
  expect_content(zstd(""), "");
  expect_content(zstd("") + zstd(""), "");
  expect_content(zstd_skippable("only this"), "");
}

TEST(Zstd, Frames)
{
  const std::string a = rows(1000, 1), b = rows(300000, 2);
  expect_content(zstd("") + zstd(a) + zstd("") + zstd(b, { 1, false, false }) + zstd(""), a + b);
  const std::string longer(400000, 's'); // than the buffer that the file is read through
  expect_content(zstd_skippable("") + zstd(a) + zstd_skippable(longer, '\x5f') +
      zstd_skippable("x", '\x57') + zstd(b) + zstd_skippable("x"),
    a + b);
}

TEST(Zstd, OtherBytesBehind)
{
  const std::string packed = zstd("content");
  for (const std::string behind : { "ITEM: TIMESTEP\n", "\x1f\x8b\x08\0\0\0\0\0\0\0" })
  {
    EXPECT_EQ(packing::error_of(packed + behind),
      "packed@" + std::to_string(packed.size()) +
        ": expected zstd data, got bytes that are none (unknown frame descriptor)");
  }
  // too few to be known for sure
  const std::string one = packed + "\n";
  const auto source = open(one);
  try
  {
    EXPECT_EQ(read_all(*source), "content");
    EXPECT_EQ(source->unchecked(), cut_text);
  }
  catch (const granular::FormatError&)
  {
  }
}

TEST(Zstd, CutAnywhere)
{
  const std::string a = rows(300, 1), b = rows(200, 2);
  const std::string first = zstd(a);
  const std::string second = zstd_skippable("metadata");
  const std::string packed = first + second + zstd(b, { 9, false, false });
  packing::expect_prefixes(packed, a + b,
    [&](std::size_t length)
    {
      return length == first.size() || length == first.size() + second.size() ||
        length == packed.size();
    });
  const auto source = open(std::string_view(packed).substr(0, packed.size() - 1));
  read_all(*source);
  EXPECT_EQ(source->unchecked(), cut_text);
}

// Of a frame that is not complete there are the blocks that are: 128 KiB each.
TEST(Zstd, CutBetweenBlocks)
{
  const std::string content = rows(1 << 20);
  const std::string packed = zstd(content);
  for (std::size_t eighth = 1; eighth < 8; ++eighth)
  {
    const auto source = open(std::string_view(packed).substr(0, packed.size() * eighth / 8));
    const std::string text = read_all(*source);
    EXPECT_TRUE(text == content.substr(0, text.size()));
    EXPECT_GE(text.size(), (eighth - 1) << 17);
    EXPECT_EQ(source->unchecked(), cut_text);
    EXPECT_EQ(read_all(*source, 1000, static_cast<std::int64_t>(text.size())), "");
    for (int again = 0; again < 40; ++again) // zstd itself would lose patience
    {
      char byte = 0;
      EXPECT_EQ(source->read(static_cast<std::int64_t>(text.size()), &byte, 1), 0u);
    }
    EXPECT_TRUE(read_all(*source) == text);
  }
}

TEST(Zstd, EveryByteDamaged)
{
  const std::string a = rows(300, 1), b = rows(100, 2);
  const std::string packed = zstd(a) + zstd(b, { 19, true, false });
  const Outcomes outcomes = packing::damage(packed, a + b);
  EXPECT_EQ(outcomes.silent, 0);
  EXPECT_LE(outcomes.plain, 4 * 5); // the first four bytes
  EXPECT_GT(outcomes.plain, 0);
  EXPECT_LT(outcomes.exact, 40); // bits that mean nothing, larger windows
  EXPECT_GT(outcomes.refused, 3 * static_cast<int>(packed.size()));
}

TEST(Zstd, WrongChecksum)
{
  const std::string before = zstd("x");
  std::string packed = before + zstd(rows(1000));
  packed.back() ^= 1;
  EXPECT_EQ(packing::error_of(packed),
    "packed@" + std::to_string(before.size()) +
      ": expected zstd data, got bytes that are none (restored data doesn't match checksum)");
}

TEST(Zstd, ThrowsAgain)
{
  std::string packed = zstd(rows(3 << 20));
  packed[packed.size() / 2] ^= 0x10;
  packing::expect_same_error(packed);
}

/// However the file is read: the library looks at the size in the header only if it gets a frame at once.
TEST(Zstd, ContentOfAnotherSize)
{
  const std::string content = rows(100'000);
  const std::string packed = zstd(content);
  ASSERT_EQ(packed[4] & 0xe0, 0xa0) << "one segment, and four bytes of size";
  for (const int more : { -1, 1 })
  {
    std::string other = packed;
    other[5] = static_cast<char>(other[5] + more);
    for (const std::size_t piece : { 777u, 70'000u, 300'000u })
    {
      EXPECT_THROW(read_all(*open(other), piece), granular::FormatError) << piece;
    }
  }
  packing::expect_prefixes(zstd(rows(300)), rows(300),
    [&](std::size_t length) { return length == zstd(rows(300)).size(); });
}

TEST(Zstd, LargestWindow)
{
  expect_content(frame_with_window(17, 0), "abc"); // 128 MiB
  expect_content(frame_with_window(17, 0, true), "abc");
  expect_content(frame_of_one_segment(3), "abc");
  const std::string before = zstd("x");
  for (const std::string& frame : { frame_with_window(17, 1), frame_with_window(18, 0),
         frame_with_window(31, 7), frame_with_window(17, 1, true), frame_with_window(31, 7, true),
         frame_of_one_segment(1 << 28) })
  {
    const std::string packed = before + frame;
    const auto source = open(packed);
    try
    {
      read_all(*source);
      FAIL() << testing::PrintToString(frame);
    }
    catch (const granular::LimitError& error)
    {
      EXPECT_EQ(error.what(),
        "packed@" + std::to_string(before.size()) +
          ": expected a zstd window of at most 128 MiB, got a larger one");
    }
    EXPECT_THROW(read_all(*source), granular::LimitError);
  }
}

TEST(Zstd, RandomReads)
{
  const std::string content = rows(6 << 20, 5);
  packing::Medium medium{ packing::zstd_frames(content, 50000) };
  const auto points = packing::expect_points_to_serve(medium, content, 21);
  EXPECT_EQ(points->points.size(), (content.size() - 1) / 150000); // every third frame
  EXPECT_EQ(points->bytes(), points->points.capacity() * sizeof(SeekPoints::Point));
}

TEST(Zstd, RandomReadsOfOneFrame)
{
  const std::string content = rows(3 << 20, 6);
  packing::expect_random_reads(*open(zstd(content)), content, 50, 23);
}

TEST(Zstd, GrowsBetweenTwoSources)
{
  const std::string content = rows(3 << 20);
  packing::expect_growth_between_sources(packing::zstd_frames(content, 200000), content, cut_text);
}

TEST(Zstd, GrowsWhileOpen)
{
  const std::string content = rows(5000);
  packing::expect_growth_while_open(
    zstd(content.substr(0, 3000)) + zstd(content.substr(3000)), content);
}

TEST(Zstd, ManyPointsAreThinned)
{
  const std::string content = rows(3 << 20);
  const std::string packed = packing::zstd_frames(content, 1000);
  const auto points = spaced(1);
  EXPECT_TRUE(read_all(*open(packed, points)) == content);
  EXPECT_LE(points->points.size(), 1024u);
  EXPECT_GE(points->points.size(), 500u);
  packing::expect_random_reads(*open(packed, points), content, 200, 24);
}
