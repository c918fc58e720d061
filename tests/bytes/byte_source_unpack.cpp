// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_source.h"

#include "../support/byte_source_packing.h"
#include "granular/common/error.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

using granular::open_memory;
using granular::unpack;
using packing::open;
using packing::read_all;
using packing::rows;

TEST(Unpack, LeavesAllElseAsItIs)
{
  for (const std::string_view content : { std::string_view(""), std::string_view("("),
         std::string_view("\x1f"), std::string_view("\x1f\x8b\x07"), std::string_view("\x1f\x9d"),
         std::string_view("P*M and so on"), std::string_view("P*"), std::string_view("P*M"),
         std::string_view("\0\0\0\0\0", 5), std::string_view("ITEM: TIMESTEP\n0\n") })
  {
    auto plain = open_memory(content);
    const granular::ByteSource* const before = plain.get();
    const auto source = unpack(std::move(plain));
    EXPECT_EQ(source.get(), before) << content;
    EXPECT_FALSE(source->compressed());
    EXPECT_EQ(source->unchecked(), "");
    EXPECT_EQ(read_all(*source), content);
  }
}

// Compressed twice is unpacked once.
TEST(Unpack, TakesOffOneLayer)
{
  const std::string inner = packing::zstd("content");
  EXPECT_EQ(read_all(*open(packing::gzip(inner))), inner);
}

TEST(Unpack, FractionOfPlainBytes)
{
  const auto source = open_memory("0123456789");
  EXPECT_EQ(source->fraction(0), 0.0);
  EXPECT_EQ(source->fraction(5), 0.5);
  EXPECT_EQ(source->fraction(10), 1.0);
  EXPECT_EQ(source->fraction(11), 1.0);
  EXPECT_EQ(open_memory("")->fraction(0), 1.0);
}

TEST(Unpack, FractionOfCompressedBytes)
{
  const std::string content = rows(4 << 20);
  for (const std::string& packed : { packing::gzip(content, { 1 }), packing::zstd(content) })
  {
    const auto source = open(packed);
    std::vector<char> buffer(1 << 18);
    double last = 0;
    for (std::int64_t offset = 0; offset < 4 << 20; offset += 1 << 18)
    {
      ASSERT_EQ(source->read(offset, buffer.data(), buffer.size()), buffer.size());
      const double fraction = source->fraction(offset + (1 << 18));
      EXPECT_GE(fraction, last);
      EXPECT_NEAR(fraction, static_cast<double>(offset + (1 << 18)) / (4 << 20), 0.1);
      last = fraction;
    }
    EXPECT_EQ(source->read(4 << 20, buffer.data(), 1), 0u);
    EXPECT_EQ(source->fraction(4 << 20), 1.0);
  }
}

TEST(Unpack, NothingIsAskedFor)
{
  const std::string packed = packing::gzip("content");
  const auto source = open(packed);
  char byte = 'x';
  EXPECT_EQ(source->read(0, &byte, 0), 0u);
  EXPECT_EQ(source->read(3, &byte, 0), 0u);
  EXPECT_EQ(source->read(std::int64_t{ 1 } << 40, &byte, 0), 0u);
  EXPECT_EQ(source->read(std::int64_t{ 1 } << 40, &byte, 1), 0u);
  EXPECT_EQ(source->read(6, &byte, 1), 1u);
  EXPECT_EQ(byte, 't');
}

// More in one piece than the source keeps.
TEST(Unpack, OneLongRead)
{
  const std::string content = rows(5000000);
  for (const std::string& packed : { packing::gzip(content, { 1 }), packing::zstd(content) })
  {
    const auto source = open(packed);
    EXPECT_TRUE(read_all(*source, 6000000) == content);
    EXPECT_TRUE(read_all(*source, 3000000, 1234567) == content.substr(1234567));
  }
}

// The last MiB can be had again without the file.
TEST(Unpack, KeepsTheLastMiB)
{
  const std::string content = rows(3 << 20);
  for (const std::string& packed : { packing::gzip(content, { 1 }), packing::zstd(content) })
  {
    packing::Medium medium{ packed };
    const auto source = unpack(packing::open_medium(medium));
    std::vector<char> buffer(1 << 20);
    EXPECT_EQ(source->read(2 << 20, buffer.data(), 1 << 20), buffer.size());
    medium.broken = true;
    EXPECT_EQ(source->read(2 << 20, buffer.data(), 1 << 20), buffer.size());
    EXPECT_TRUE(content.compare(2 << 20, 1 << 20, buffer.data(), buffer.size()) == 0);
    EXPECT_THROW(source->read((2 << 20) - 1, buffer.data(), 1), granular::IoError);
  }
}

TEST(Unpack, AnErrorOfTheSystemMayPass)
{
  const std::string content = rows(3 << 20);
  for (const std::string& packed : { packing::gzip(content, { 1 }), packing::zstd(content) })
  {
    packing::Medium medium{ packed };
    const auto source = unpack(packing::open_medium(medium));
    std::vector<char> buffer(1 << 20);
    EXPECT_EQ(source->read(0, buffer.data(), 1000), 1000u);
    medium.broken = true;
    EXPECT_THROW(source->read(1 << 20, buffer.data(), 1 << 20), granular::IoError);
    EXPECT_THROW(source->read(0, buffer.data(), 1), granular::IoError);
    medium.broken = false;
    EXPECT_EQ(source->read(1 << 20, buffer.data(), 1 << 20), buffer.size());
    EXPECT_TRUE(content.compare(1 << 20, 1 << 20, buffer.data(), buffer.size()) == 0);
    EXPECT_TRUE(read_all(*source) == content);
  }
  packing::Medium broken{ packing::gzip("content"), 0, true };
  EXPECT_THROW(unpack(packing::open_medium(broken)), granular::IoError);
}
