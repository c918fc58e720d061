// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/compression.h"

#include "../support/byte_source_packing.h"
#include "../support/own_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace
{
using granular::compress;
using granular::Compression;

class Compress : public OwnFolder
{
protected:
  /// What a program of the system makes of it.
  std::string unpacked_by(const std::string& program, const std::string& packed) const
  {
    const std::string in = this->write("packed", packed);
    const std::string out = this->path("unpacked");
    const std::string command = program + " -d -c < '" + in + "' > '" + out + "'";
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::ifstream stream(out, std::ios::binary);
    return { std::istreambuf_iterator<char>(stream), {} };
  }
};

bool installed(const std::string& program)
{
  return std::system((program + " --version > /dev/null 2>&1").c_str()) == 0;
}

/// From nothing to more than a window, and what cannot be made smaller.
std::vector<std::string> contents()
{
  std::string noise(100'000, '\0');
  unsigned state = 1;
  for (char& byte : noise)
  {
    state = state * 1664525u + 1013904223u;
    byte = static_cast<char>(state >> 24);
  }
  return { "", "x", std::string("\0\xff\n", 3), packing::rows(5000), packing::rows(3'000'000),
    noise };
}

struct Format
{
  Compression how;
  std::string program;
  std::string magic;
};

const std::vector<Format> formats = { { Compression::Gzip, "gzip", "\x1f\x8b\x08" },
  { Compression::Zstd, "zstd", "\x28\xb5\x2f\xfd" } };
}

TEST_F(Compress, NoneIsAsItIs)
{
  EXPECT_EQ(compress("bytes", Compression::None), "bytes");
  EXPECT_EQ(compress("", Compression::None), "");
}

TEST_F(Compress, IsReadAgain)
{
  for (const Format& format : formats)
  {
    std::string all_packed;
    std::string all;
    for (const std::string& content : contents())
    {
      const std::string packed = compress(content, format.how);
      EXPECT_EQ(packed.substr(0, format.magic.size()), format.magic);
      EXPECT_TRUE(packing::read_all(*packing::open(packed)) == content) << format.program;
      EXPECT_TRUE(compress(content, format.how) == packed) << "the same bytes always";
      all_packed += packed;
      all += content;
    }
    EXPECT_TRUE(packing::read_all(*packing::open(all_packed)) == all) << format.program;
  }
}

TEST_F(Compress, ProgramsReadIt)
{
  int tried = 0;
  for (const Format& format : formats)
  {
    if (!installed(format.program))
    {
      continue;
    }
    ++tried;
    std::string all_packed;
    std::string all;
    for (const std::string& content : contents())
    {
      all_packed += compress(content, format.how);
      all += content;
      EXPECT_TRUE(this->unpacked_by(format.program, all_packed) == all) << format.program;
    }
  }
  if (tried == 0)
  {
    GTEST_SKIP() << "neither gzip nor zstd is installed";
  }
}

/// The headers hold no time, no name and no system that would make equal bytes differ; and the checksum.
TEST_F(Compress, HeadersAreBare)
{
  const std::string member = compress("x", Compression::Gzip);
  EXPECT_EQ(member.substr(3, 5), std::string(5, '\0')); // no flags, no time
  // RFC 8878: bit 2 of the descriptor says that a checksum follows the data
  EXPECT_EQ(compress("x", Compression::Zstd).at(4) & 4, 4);
}

/// Broken data are noticed.
TEST_F(Compress, ChecksumsHold)
{
  for (const Format& format : formats)
  {
    std::string packed = compress(packing::rows(5000), format.how);
    packed[packed.size() - (format.how == Compression::Gzip ? 5 : 1)] ^= 1;
    EXPECT_NE(packing::error_of(packed), "") << format.program;
  }
}

TEST_F(Compress, RowsBecomeSmaller)
{
  const std::string rows = packing::rows(1'000'000);
  for (const Format& format : formats)
  {
    const std::string packed = compress(rows, format.how);
    EXPECT_LT(packed.size(), rows.size() * 6 / 10) << format.program;
    EXPECT_LT(packed.capacity(), packed.size() + 64) << format.program;
  }
}
