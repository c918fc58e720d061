// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/byte_sink.h"

#include "granular/base/error.h"

#include "own_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace
{
namespace fs = std::filesystem;
using granular::write_file;

class WriteFile : public OwnFolder
{
protected:
  std::string content(const std::string& name) const
  {
    std::ifstream stream(this->path(name), std::ios::binary);
    return { std::istreambuf_iterator<char>(stream), {} };
  }

  /// The names in the folder, sorted: nothing else may be left there.
  std::vector<std::string> names() const
  {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(this->folder()))
    {
      names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
};

using Names = std::vector<std::string>;

void expect_fails(const std::string& path, const std::string& bytes, std::errc code)
{
  try
  {
    write_file(path, bytes);
    FAIL() << "wrote " << path;
  }
  catch (const granular::IoError& error)
  {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_EQ(error.where().path, path);
    EXPECT_EQ(error.text(), "cannot write: " + std::make_error_code(code).message());
  }
}
}

TEST_F(WriteFile, ANewFileAndOneInPlaceOfAnother)
{
  const std::string bytes = std::string("\0\n\xff", 3) + std::string(100'000, 'x');
  write_file(this->path("a"), bytes);
  EXPECT_EQ(this->content("a"), bytes);
  write_file(this->path("a"), "short");
  EXPECT_EQ(this->content("a"), "short");
  write_file(this->path("a"), "");
  EXPECT_EQ(this->content("a"), "");
  EXPECT_EQ(this->names(), Names{ "a" });
}

TEST_F(WriteFile, WithoutAFolderInItsNameItIsTheWorkingOne)
{
  const fs::path before = fs::current_path();
  fs::current_path(this->folder());
  write_file("here", "bytes");
  fs::current_path(before);
  EXPECT_EQ(this->content("here"), "bytes");
}

TEST_F(WriteFile, WhoReadsTheOldFileGoesOnReadingIt)
{
  write_file(this->path("a"), "old");
  std::ifstream reader(this->path("a"));
  write_file(this->path("a"), "new");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(reader), {}), "old");
  EXPECT_EQ(this->content("a"), "new");
}

TEST_F(WriteFile, MayBeReadByWhomeverTheUserLetsRead)
{
  const mode_t before = ::umask(022);
  write_file(this->path("a"), "bytes");
  ::umask(before);
  EXPECT_EQ(fs::status(this->path("a")).permissions(), fs::perms(0644));
}

TEST_F(WriteFile, NothingIsLeftOfWhatFailed)
{
  fs::create_directory(this->path("folder"));
  write_file(this->path("file"), "");
  expect_fails(this->path("folder"), "x", std::errc::is_a_directory);
  expect_fails(this->path("missing/file"), "x", std::errc::no_such_file_or_directory);
  expect_fails(this->path("file/below"), "x", std::errc::not_a_directory);
  expect_fails(this->path(std::string(300, 'x')), "x", std::errc::filename_too_long);
  expect_fails("", "x", std::errc::no_such_file_or_directory);
  EXPECT_EQ(this->names(), (Names{ "file", "folder" }));
}

TEST_F(WriteFile, AFullDiskLeavesTheOldFile)
{
  write_file(this->path("a"), "old");
  // a limit of the system does what a full disk does
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit limit = before;
  limit.rlim_cur = 1000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
  expect_fails(this->path("a"), std::string(5000, 'x'), std::errc::file_too_large);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(this->content("a"), "old");
  EXPECT_EQ(this->names(), Names{ "a" });
}

TEST_F(WriteFile, WhereNothingMayBeWritten)
{
  write_file(this->path("a"), "old");
  ASSERT_EQ(::chmod(this->folder().c_str(), 0555), 0);
  const bool root = ::geteuid() == 0;
  constexpr uid_t nobody = 65534;
  if (root && ::seteuid(nobody) != 0)
  {
    GTEST_SKIP() << "root may write everywhere here";
  }
  expect_fails(this->path("a"), "new", std::errc::permission_denied);
  if (root)
  {
    ASSERT_EQ(::seteuid(0), 0);
  }
  ASSERT_EQ(::chmod(this->folder().c_str(), 0755), 0);
  EXPECT_EQ(this->content("a"), "old");
}

TEST_F(WriteFile, WhatACrashLeftBehindIsPassedOver)
{
  const std::string left = ".granular-" + std::to_string(::getpid()) + "-0.tmp";
  std::ofstream(this->path(left)) << "left";
  write_file(this->path("a"), "bytes");
  EXPECT_EQ(this->content("a"), "bytes");
  EXPECT_EQ(this->content(left), "left");
  EXPECT_EQ(this->names(), (Names{ left, "a" }));
}

TEST_F(WriteFile, ManyAtATimeEachOneWhole)
{
  constexpr std::size_t bytes = 200'000;
  std::vector<std::thread> writers;
  for (char letter = 'a'; letter < 'i'; ++letter)
  {
    writers.emplace_back(
      [this, letter]
      {
        for (int i = 0; i < 20; ++i)
        {
          write_file(this->path("file"), std::string(bytes, letter));
        }
      });
  }
  for (std::thread& writer : writers)
  {
    writer.join();
  }
  const std::string last = this->content("file");
  ASSERT_EQ(last.size(), bytes);
  EXPECT_EQ(std::count(last.begin(), last.end(), last[0]), static_cast<std::ptrdiff_t>(bytes));
  EXPECT_EQ(this->names(), Names{ "file" });
}
