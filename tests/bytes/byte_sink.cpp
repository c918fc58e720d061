// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_sink.h"

#include "granular/common/error.h"

#include "../support/own_folder.h"
#include "../support/small_disk.h"
#include "../support/write_file.h"

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
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
namespace fs = std::filesystem;
using granular::Locking;
using granular::NewFile;

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

/// Who may not write a file may not put another in its place, though the folder would let him.
TEST_F(WriteFile, WhatIsWriteProtected)
{
  write_file(this->path("a"), "old");
  ASSERT_EQ(::chmod(this->path("a").c_str(), 0444), 0);
  ASSERT_EQ(::chmod(this->folder().c_str(), 0777), 0);
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
  EXPECT_EQ(this->content("a"), "old");
  EXPECT_EQ(this->names(), Names{ "a" });
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

TEST_F(WriteFile, WhatIsNoFileIsNeverReplaced)
{
  ASSERT_EQ(::mkfifo(this->path("pipe").c_str(), 0644), 0);
  fs::create_symlink("pipe", this->path("link"));
  const int socket = ::socket(AF_UNIX, SOCK_STREAM, 0);
  const fs::path before = fs::current_path();
  fs::current_path(this->folder()); // the name of a socket is short
  const sockaddr_un name = { AF_UNIX, "socket" };
  ASSERT_EQ(::bind(socket, reinterpret_cast<const sockaddr*>(&name), sizeof(name)), 0);
  fs::current_path(before);
  for (const std::string& path : { this->path("pipe"), this->path("link"), this->path("socket"),
         std::string("/dev/null"), std::string("/dev/full") })
  {
    const fs::file_type type = fs::status(path).type();
    try
    {
      write_file(path, "bytes");
      ADD_FAILURE() << "wrote " << path;
    }
    catch (const granular::IoError& error)
    {
      EXPECT_EQ(error.what(), path + ": cannot write: expected a file, got a device or a pipe");
      EXPECT_EQ(error.code(), std::errc::not_supported);
    }
    EXPECT_EQ(fs::status(path).type(), type) << path;
  }
  ::close(socket);
  EXPECT_EQ(this->names(), (Names{ "link", "pipe", "socket" }));
}

TEST_F(WriteFile, LinksStayAndTheFileBehindThemIsReplaced)
{
  fs::create_directories(this->path("far/deep"));
  write_file(this->path("far/file"), "old");
  fs::create_symlink("far/deep", this->path("folder"));
  fs::create_symlink("../file", this->path("far/deep/second")); // from far/deep, not from folder
  fs::create_symlink("folder/second", this->path("first"));
  write_file(this->path("first"), "new");
  EXPECT_EQ(this->content("far/file"), "new");
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(this->path("far/file"))));
  EXPECT_EQ(fs::read_symlink(this->path("first")), "folder/second");
  EXPECT_EQ(fs::read_symlink(this->path("far/deep/second")), "../file");

  fs::create_symlink(this->path("far/none"), this->path("dangling"));
  write_file(this->path("dangling"), "bytes");
  EXPECT_EQ(this->content("far/none"), "bytes");
  EXPECT_TRUE(fs::is_symlink(this->path("dangling")));

  fs::create_symlink("round", this->path("about"));
  fs::create_symlink("about", this->path("round"));
  expect_fails(this->path("round"), "x", std::errc::too_many_symbolic_link_levels);
  fs::create_symlink("missing/file", this->path("nowhere"));
  expect_fails(this->path("nowhere"), "x", std::errc::no_such_file_or_directory);
  expect_fails(this->path("folder"), "x", std::errc::is_a_directory);
  EXPECT_EQ(
    this->names(), (Names{ "about", "dangling", "far", "first", "folder", "nowhere", "round" }));
}

TEST_F(WriteFile, PermissionsStay)
{
  for (const mode_t mode : { 0600u, 0640u, 0755u, 0666u, 0444u })
  {
    write_file(this->path("a"), "old");
    ASSERT_EQ(::chmod(this->path("a").c_str(), mode), 0);
    if (mode == 0444u && ::geteuid() != 0)
    {
      EXPECT_THROW(
        NewFile(this->path("a")), granular::IoError); // who may not write it may not replace it
      EXPECT_EQ(this->content("a"), "old");
      continue;
    }
    {
      NewFile file(this->path("a"));
      EXPECT_EQ(fs::status(file.temporary_name()).permissions(), fs::perms(0600));
      file.finish(true);
    }
    EXPECT_EQ(fs::status(this->path("a")).permissions(), fs::perms(mode));
    EXPECT_EQ(this->content("a"), "");
  }
}

TEST_F(WriteFile, OwnerAndGroupStayOrTheFileIsRefused)
{
  if (::geteuid() != 0)
  {
    GTEST_SKIP() << "only root may give files away";
  }
  constexpr unsigned user = 1234;
  constexpr unsigned group = 2345;
  fs::permissions(this->folder(), fs::perms::all);
  for (const Locking locking : { Locking::Own, Locking::Others })
  {
    write_file(this->path("a"), "old");
    ASSERT_EQ(::chmod(this->path("a").c_str(), 0666), 0);
    ASSERT_EQ(::chown(this->path("a").c_str(), user, group), 0);
    {
      NewFile file(this->path("a"), locking);
      file.finish(false);
    }
    struct stat now = {};
    ASSERT_EQ(::stat(this->path("a").c_str(), &now), 0);
    EXPECT_EQ(now.st_uid, user);
    EXPECT_EQ(now.st_gid, group);
    EXPECT_EQ(now.st_mode & 0777, 0666u);

    const pid_t child = ::fork(); // as another user, who may write the file and its folder
    if (child == 0)
    {
      fs::current_path(this->folder()); // that user may not pass the folders before
      const bool other = ::setresgid(group, group, group) == 0 && ::setresuid(77, 77, 77) == 0;
      try
      {
        const NewFile file("a", locking);
        ::_exit(1);
      }
      catch (const granular::IoError& error)
      {
        ::_exit(other && error.code() == std::errc::operation_not_permitted ? 0 : 2);
      }
    }
    int status = -1;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(this->names(), Names{ "a" });
  }
}

TEST_F(WriteFile, PartsInAnyOrderAndFromAnyThread)
{
  constexpr std::size_t parts = 64;
  constexpr std::size_t bytes = 10'007;
  std::string expected;
  for (std::size_t part = 0; part < parts; ++part)
  {
    expected += std::string(bytes, static_cast<char>('!' + part));
  }
  {
    NewFile file(this->path("a"));
    std::vector<std::jthread> writers;
    for (std::size_t first = 0; first < 4; ++first)
    {
      writers.emplace_back(
        [&, first]
        {
          for (std::size_t part = parts - 4 + first; part < parts; part -= 4)
          {
            file.write_at(static_cast<std::int64_t>(part * bytes),
              std::string_view(expected).substr(part * bytes, bytes));
          }
        });
    }
    writers.clear();
    file.write_at(3, {});
    EXPECT_FALSE(fs::exists(this->path("a")));
    file.finish(true);
  }
  EXPECT_TRUE(this->content("a") == expected);
  EXPECT_EQ(this->names(), Names{ "a" });
}

TEST_F(WriteFile, BeyondTheEndIsZeroUpToThere)
{
  constexpr std::int64_t far = (std::int64_t{ 5 } << 30) + 1;
  NewFile file(this->path("a"));
  file.write_at(far, "end");
  file.write_at(0, "begin");
  file.finish(true);
  EXPECT_EQ(fs::file_size(this->path("a")), static_cast<std::uintmax_t>(far) + 3);
  std::ifstream stream(this->path("a"), std::ios::binary);
  std::string begin(7, 'x');
  stream.read(begin.data(), 7);
  EXPECT_EQ(begin, std::string("begin\0\0", 7));
  std::string end(5, 'x');
  stream.seekg(far - 1);
  stream.read(end.data(), 4);
  EXPECT_EQ(end, std::string("\0endx", 5));
}

TEST_F(WriteFile, WithoutFinishNothingIsLeft)
{
  write_file(this->path("a"), "old");
  {
    NewFile file(this->path("a"));
    file.write_at(0, "new bytes");
    EXPECT_EQ(this->names().size(), 2u);
  }
  EXPECT_EQ(this->content("a"), "old");
  EXPECT_EQ(this->names(), Names{ "a" });
}

TEST_F(WriteFile, AFullFileSystem)
{
  const SmallDisk disk(this->path("disk"));
  if (!disk.there())
  {
    GTEST_SKIP() << SmallDisk::not_there;
  }
  write_file(disk.path("a"), "old");
  expect_fails(disk.path("a"), std::string(300'000, 'x'), std::errc::no_space_on_device);
  EXPECT_EQ(this->content("disk/a"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(this->path("disk")), {}), 1);
  write_file(disk.path("a"), std::string(200'000, 'x')); // the room is there again
  EXPECT_EQ(this->content("disk/a").size(), 200'000u);
}
