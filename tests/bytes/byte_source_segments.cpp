// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_source.h"

#include "../support/byte_source_packing.h"
#include "granular/common/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace
{
using granular::ByteSource;
using granular::SeekPoints;
using packing::gzip;
using packing::rows;
using packing::spaced;

constexpr std::int64_t whole = std::numeric_limits<std::int64_t>::max();

/// Bytes in memory for many threads, which count what is read of them, and may fail.
class CountedSource final : public ByteSource
{
public:
  CountedSource(std::string_view bytes, std::atomic<std::int64_t>& count, std::atomic<bool>& broken)
    : bytes_(granular::open_memory(bytes, "packed"))
    , count_(count)
    , broken_(broken)
  {
  }

  const std::string& path() const override { return bytes_->path(); }
  granular::FileStamp stamp() const override { return bytes_->stamp(); }
  bool concurrent() const override { return true; }

  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override
  {
    if (broken_)
    {
      throw granular::IoError("cannot read: Input/output error", { "packed" });
    }
    const std::size_t got = bytes_->read(offset, buffer, bytes);
    count_ += static_cast<std::int64_t>(got);
    return got;
  }

private:
  std::unique_ptr<ByteSource> bytes_;
  std::atomic<std::int64_t>& count_;
  std::atomic<bool>& broken_;
};

/// A packed file, its content, and points in it.
struct Packed
{
  std::string content;
  std::string bytes;
  std::shared_ptr<SeekPoints> points = spaced(1 << 18);
  std::atomic<std::int64_t> count = 0;
  std::atomic<bool> broken = false;

  void index() { EXPECT_TRUE(packing::read_all(*packing::open(bytes, points)) == content); }

  std::unique_ptr<ByteSource> open(
    std::int64_t begin = 0, std::int64_t end = whole, int threads = 3)
  {
    std::unique_ptr<ByteSource> source = std::make_unique<CountedSource>(bytes, count, broken);
    end = std::min(end, static_cast<std::int64_t>(content.size()));
    return granular::unpack_segments(source, *points, begin, end, threads);
  }
};

/// One long member; many; with a table of the fields of a header; frames of Zstandard.
void make(Packed& packed, int kind)
{
  packed.content = rows(6 << 20, 5);
  const std::string_view content = packed.content;
  switch (kind)
  {
    case 0:
      packed.bytes = gzip(content, { 1 });
      break;
    case 1:
      for (std::size_t at = 0; at < content.size(); at += 70000)
      {
        packed.bytes += gzip(content.substr(at, 70000), { 1 });
      }
      break;
    case 2:
      packed.bytes = gzip(content.substr(0, 2500000), { 1, 0, true }) + gzip("") +
        gzip(content.substr(2500000), { 1 });
      break;
    default:
      packed.bytes = packing::zstd_frames(content, 90000);
      break;
  }
  packed.index();
}

constexpr int kinds = 4;

/// Made once: to pack takes longer than all else.
void fill(Packed& packed, int kind)
{
  static std::array<Packed, kinds> made;
  Packed& one = made.at(static_cast<std::size_t>(kind));
  if (one.bytes.empty())
  {
    make(one, kind);
  }
  packed.content = one.content;
  packed.bytes = one.bytes;
  *packed.points = *one.points;
}

/// Blocks of a size that divides nothing, read by several threads that take turns.
void expect_reads(const ByteSource& source, std::string_view content, std::int64_t begin,
  std::int64_t end, int threads)
{
  constexpr std::int64_t block = 99991;
  std::atomic<std::int64_t> next = begin;
  const auto read = [&]
  {
    std::string buffer(block, '\0');
    for (std::int64_t at = next.fetch_add(block); at < end; at = next.fetch_add(block))
    {
      const auto bytes = static_cast<std::size_t>(std::min(block, end - at));
      ASSERT_EQ(source.read(at, buffer.data(), bytes), bytes);
      ASSERT_TRUE(content.substr(static_cast<std::size_t>(at), bytes) ==
        std::string_view(buffer).substr(0, bytes));
    }
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i)
  {
    others.emplace_back(read);
  }
  read();
  for (std::thread& other : others)
  {
    other.join();
  }
}
}

TEST(Segments, GiveTheContentToManyThreads)
{
  for (int kind = 0; kind < kinds; ++kind)
  {
    Packed packed;
    fill(packed, kind);
    for (const int threads : { 1 + kind, 8 })
    {
      const auto source = packed.open(0, whole, std::max(threads, 2));
      ASSERT_TRUE(source) << kind;
      EXPECT_TRUE(source->compressed());
      EXPECT_TRUE(source->concurrent());
      EXPECT_EQ(source->path(), "packed");
      EXPECT_EQ(source->stamp().size, static_cast<std::int64_t>(packed.bytes.size()));
      expect_reads(
        *source, packed.content, 0, static_cast<std::int64_t>(packed.content.size()), threads);
    }
  }
}

TEST(Segments, OfAFrameInTheMiddle)
{
  for (int kind = 0; kind < kinds; ++kind)
  {
    Packed packed;
    fill(packed, kind);
    const std::int64_t begin = 2'345'678;
    const std::int64_t end = 4'000'001;
    const auto source = packed.open(begin, end);
    ASSERT_TRUE(source);
    expect_reads(*source, packed.content, begin, end, 3);
    char byte = 0;
    EXPECT_EQ(source->read(end, &byte, 1), 0u);
    EXPECT_EQ(source->read(end - 1, &byte, 1), 1u);
  }
}

TEST(Segments, RandomReads)
{
  for (int kind = 0; kind < kinds; ++kind)
  {
    Packed packed;
    fill(packed, kind);
    const auto source = packed.open(0, whole, 2);
    packing::expect_random_reads(*source, packed.content, 500, 3);
  }
}

TEST(Segments, EachIsDecompressedOnce)
{
  Packed packed;
  fill(packed, 0);
  const auto source = packed.open(0, whole, 3);
  expect_reads(*source, packed.content, 0, static_cast<std::int64_t>(packed.content.size()), 3);
  // each decoder reads 256 KiB at a time, of which a segment needs a part
  const auto segments = static_cast<std::int64_t>(packed.points->points.size()) + 1;
  EXPECT_LE(packed.count, segments << 18);
}

TEST(Segments, NotWhereTheyWouldNotHelp)
{
  Packed packed;
  fill(packed, 0);
  EXPECT_FALSE(packed.open(0, whole, 1));
  EXPECT_FALSE(packed.open(0, 1 << 16));
  packed.points = std::make_shared<SeekPoints>();
  EXPECT_FALSE(packed.open());
  packed.points->points = { { 1 << 20, 1000, 0, 0, 0, {} }, { 2 << 20, 2000, 0, 0, 0, {} } };
  packed.content.resize((std::size_t{ 2 } << 20) + (std::size_t{ 65 } << 20));
  EXPECT_FALSE(packed.open());

  auto plain = granular::open_memory("plain", "plain");
  EXPECT_FALSE(granular::unpack_segments(plain, *packed.points, 0, 5, 2));
  EXPECT_TRUE(plain) << "it is still there for others";
  packing::Medium medium{ packed.bytes };
  auto alone = packing::open_medium(medium);
  EXPECT_FALSE(granular::unpack_segments(alone, *packed.points, 0, 3 << 20, 2));
}

TEST(Segments, DamageIsMetByWhoNeedsIt)
{
  for (const int kind : { 0, 3 })
  {
    Packed packed;
    fill(packed, kind);
    const std::size_t middle = packed.points->points.size() / 2;
    const SeekPoints::Point& point = packed.points->points[middle];
    for (std::size_t i = 0; i < 40; ++i)
    {
      packed.bytes[static_cast<std::size_t>(point.packed) + 200 + i] ^= '\x55';
    }
    const auto source = packed.open();
    expect_reads(*source, packed.content, 0, point.offset, 3);
    const std::int64_t next = packed.points->points[middle + 1].offset;
    std::string buffer(static_cast<std::size_t>(next - point.offset), '\0');
    bool refused = false;
    for (int i = 0; i < 2; ++i)
    {
      try
      {
        source->read(point.offset, buffer.data(), buffer.size());
      }
      catch (const granular::FormatError& error)
      {
        refused = true;
        EXPECT_GE(error.where().byte, point.packed);
      }
    }
    EXPECT_TRUE(refused);
    expect_reads(*source, packed.content, next, next + 1000, 1);
  }
}

/// A byte that is stored becomes another: the data make sense, and sums alone tell, which must not wait for the end of the member.
TEST(Segments, DamageThatOnlySumsTell)
{
  Packed packed;
  packed.content = rows(6 << 20, 5);
  packed.bytes = gzip(packed.content, { 0 });
  packed.index();
  ASSERT_GT(packed.points->points.size(), 6u);
  const SeekPoints::Point& point = packed.points->points[5];
  packed.bytes[static_cast<std::size_t>(point.packed) + 1000] ^= 1;
  const auto source = packed.open();
  expect_reads(*source, packed.content, 0, point.offset, 2);
  std::string buffer(100, '\0');
  EXPECT_THROW(source->read(point.offset, buffer.data(), buffer.size()), granular::FormatError);
}

TEST(Segments, AnErrorOfTheSystemMayPass)
{
  Packed packed;
  fill(packed, 0);
  const auto source = packed.open();
  char byte = 0;
  packed.broken = true;
  EXPECT_THROW(source->read(3 << 20, &byte, 1), granular::IoError);
  packed.broken = false;
  expect_reads(*source, packed.content, 0, static_cast<std::int64_t>(packed.content.size()), 3);
}

TEST(Segments, TruncatedFilesEndEarly)
{
  Packed packed;
  fill(packed, 0);
  packed.bytes.resize(packed.bytes.size() / 2);
  const auto source = packed.open();
  std::string buffer(1 << 20, '\0');
  EXPECT_EQ(source->read(5 << 20, buffer.data(), buffer.size()), 0u);
  EXPECT_EQ(source->read(1 << 20, buffer.data(), buffer.size()), buffer.size());
  const std::size_t got = source->read(5 << 19, buffer.data(), buffer.size());
  EXPECT_LT(got, buffer.size());
  EXPECT_EQ(std::string_view(buffer).substr(0, got),
    std::string_view(packed.content).substr(std::size_t{ 5 } << 19, got));
}
