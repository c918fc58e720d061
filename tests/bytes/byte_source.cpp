// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_source.h"

#include "granular/common/error.h"

#include "../support/own_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include <sys/stat.h>
#include <unistd.h>

namespace
{
namespace fs = std::filesystem;
using granular::open_file;
using granular::open_memory;
using granular::PaddedBuffer;

class OpenFile : public OwnFolder
{
};

void expect_refused(const std::string& path, const std::string& why)
{
  try
  {
    open_file(path);
    FAIL() << "opened " << path;
  }
  catch (const granular::IoError& error)
  {
    EXPECT_EQ(error.what(), path + ": " + why);
    EXPECT_EQ(error.where().path, path);
  }
}
}

TEST_F(OpenFile, ReadsAnyPart)
{
  const std::string path = this->write("file", "0123456789");
  const auto source = open_file(path);
  EXPECT_EQ(source->path(), path);
  EXPECT_EQ(source->stamp().size, 10);
  char buffer[20] = {};
  EXPECT_EQ(source->read(0, buffer, 10), 10u);
  EXPECT_EQ(std::string(buffer, 10), "0123456789");
  EXPECT_EQ(source->read(7, buffer, 20), 3u);
  EXPECT_EQ(std::string(buffer, 3), "789");
  EXPECT_EQ(source->read(10, buffer, 20), 0u);
  EXPECT_EQ(source->read(1000, buffer, 20), 0u);
  EXPECT_EQ(source->read(3, buffer, 0), 0u);
}

TEST_F(OpenFile, EmptyFile)
{
  const auto source = open_file(this->write("file", ""));
  char byte = 'x';
  EXPECT_EQ(source->stamp().size, 0);
  EXPECT_EQ(source->read(0, &byte, 1), 0u);
}

TEST_F(OpenFile, RefusesWhatIsNoFile)
{
  expect_refused(this->path("."), "expected a file, got a directory: name the files in it");
  expect_refused(this->path("missing"), "cannot open: No such file or directory");
  expect_refused(this->write("file", "") + "/below", "cannot open: Not a directory");
  expect_refused("/dev/null", "expected a file, got a device or a pipe");
  fs::create_symlink("loop", this->path("loop"));
  expect_refused(this->path("loop"), "cannot open: Too many levels of symbolic links");
  fs::create_symlink("gone", this->path("dangling"));
  expect_refused(this->path("dangling"), "cannot open: No such file or directory");
  expect_refused(this->path(std::string(300, 'x')), "cannot open: File name too long");
}

// Nobody writes into it: an open that waits would never come back.
TEST_F(OpenFile, RefusesAPipeWithoutWaiting)
{
  ASSERT_EQ(::mkfifo(this->path("pipe").c_str(), 0600), 0);
  expect_refused(this->path("pipe"), "expected a file, got a device or a pipe");
}

TEST_F(OpenFile, NoPermission)
{
  const std::string path = this->write("secret", "x");
  ASSERT_EQ(::chmod(path.c_str(), 0), 0);
  const bool root = ::geteuid() == 0;
  constexpr uid_t nobody = 65534;
  if (root && ::seteuid(nobody) != 0)
  {
    GTEST_SKIP() << "root may read everything here";
  }
  expect_refused(path, "cannot open: Permission denied");
  if (root)
  {
    ASSERT_EQ(::seteuid(0), 0);
  }
}

TEST_F(OpenFile, TheStampFollowsTheFile)
{
  const std::string path = this->write("file", "1234");
  const auto source = open_file(path);
  const granular::FileStamp before = source->stamp();
  EXPECT_EQ(source->stamp(), before);
  EXPECT_EQ(open_file(path)->stamp(), before);
  std::ofstream(path, std::ios::app) << "5";
  const granular::FileStamp after = source->stamp();
  EXPECT_EQ(after.size, 5);
  EXPECT_EQ(after.inode, before.inode);
  EXPECT_NE(after, before);
  fs::resize_file(path, 1);
  EXPECT_EQ(source->stamp().size, 1);
  char buffer[4];
  // shortened while open: an error, not dead
  EXPECT_THROW(source->read(0, buffer, 4), granular::IoError);
  EXPECT_EQ(source->read(0, buffer, 1), 1u);
}

TEST_F(OpenFile, AReplacedFileHasAnotherStamp)
{
  const std::string path = this->write("file", "1234");
  const auto source = open_file(path);
  const granular::FileStamp before = source->stamp();
  fs::rename(this->write("new", "5678"), path);
  EXPECT_NE(open_file(path)->stamp().inode, before.inode);
  char buffer[4];
  EXPECT_EQ(source->read(0, buffer, 4), 4u);
  EXPECT_EQ(std::string(buffer, 4), "1234");
}

TEST_F(OpenFile, OffsetsAbove32Bits)
{
  const std::string path = this->write("sparse", "");
  constexpr std::int64_t size = (std::int64_t{ 5 } << 30) + 3;
  fs::resize_file(path, size);
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(size - 3);
    file << "end";
  }
  const auto source = open_file(path);
  EXPECT_EQ(source->stamp().size, size);
  char buffer[10];
  ASSERT_EQ(source->read(size - 3, buffer, 10), 3u);
  EXPECT_EQ(std::string(buffer, 3), "end");
}

TEST_F(OpenFile, TheFirstBytesStayWhatTheyWere)
{
  std::string bytes;
  for (int i = 0; bytes.size() < 100'000; ++i)
  {
    bytes += std::to_string(i) + " ";
  }
  const std::string path = this->write("file", bytes);
  constexpr std::size_t kept = 50'000;
  const auto source = granular::first_bytes(open_file(path), kept);
  const std::string first = bytes.substr(0, kept);
  for (const std::size_t offset : { 0u, 1u, 16'000u, 16'384u, 20'000u, 49'999u, 50'000u, 99'000u })
  {
    for (const std::size_t count : { 1u, 300u, 16'384u, 40'000u })
    {
      std::string read(count, '?');
      read.resize(source->read(static_cast<std::int64_t>(offset), read.data(), count));
      EXPECT_EQ(read, first.substr(std::min(offset, kept), count)) << offset << " " << count;
    }
  }
  this->write("file", "another");
  char byte = 0;
  EXPECT_EQ(source->read(0, &byte, 1), 1u);
  EXPECT_EQ(byte, '0');
}

TEST_F(OpenFile, SeveralThreadsMayReadPlainBytes)
{
  const std::string path = this->write("file", "some bytes");
  EXPECT_TRUE(open_file(path)->concurrent());
  EXPECT_TRUE(open_memory("some bytes")->concurrent());
  EXPECT_TRUE(granular::first_bytes(open_file(path), 4)->concurrent());
  EXPECT_TRUE(granular::unpack(open_file(path))->concurrent());
}

TEST(OpenMemory, ReadsAnyPart)
{
  const auto source = open_memory("0123456789", "name");
  EXPECT_EQ(source->path(), "name");
  EXPECT_EQ(source->stamp().size, 10);
  char buffer[20] = {};
  EXPECT_EQ(source->read(7, buffer, 20), 3u);
  EXPECT_EQ(std::string(buffer, 3), "789");
  EXPECT_EQ(source->read(10, buffer, 20), 0u);
  EXPECT_EQ(source->read(std::int64_t{ 1 } << 40, buffer, 20), 0u);
  EXPECT_EQ(open_memory("")->path(), "memory");
}

namespace
{
bool padded(const PaddedBuffer& buffer)
{
  const auto feeds = [](const char* at)
  { return std::all_of(at, at + PaddedBuffer::padding, [](char c) { return c == '\n'; }); };
  return feeds(buffer.data() - PaddedBuffer::padding) && feeds(buffer.data() + buffer.size());
}
}

TEST(PaddedBuffer, LineFeedsAround)
{
  EXPECT_TRUE(padded(PaddedBuffer()));
  PaddedBuffer buffer(5);
  EXPECT_EQ(buffer.size(), 5u);
  EXPECT_TRUE(padded(buffer));
  std::copy_n("abcde", 5, buffer.data());
  buffer.resize(100);
  EXPECT_EQ(std::string(buffer.data(), 5), "abcde");
  EXPECT_TRUE(padded(buffer));
  buffer.resize(2);
  EXPECT_EQ(std::string(buffer.data(), 2), "ab");
  EXPECT_TRUE(padded(buffer));
  buffer.resize(0);
  EXPECT_EQ(buffer.size(), 0u);
  EXPECT_TRUE(padded(buffer));
}
