// SPDX-License-Identifier: BSD-3-Clause
// What killed writers leave behind, and who removes it.

#include "granular/bytes/byte_sink.h"
#include "granular/common/error.h"

#include "../support/own_folder.h"
#include "../support/write_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{
namespace fs = std::filesystem;
using granular::LockedFile;
using granular::Locking;
using granular::NewFile;
using Names = std::set<std::string>;

class LeftFiles : public OwnFolder
{
protected:
  std::string content(const std::string& name) const
  {
    std::ifstream stream(this->path(name), std::ios::binary);
    return { std::istreambuf_iterator<char>(stream), {} };
  }

  Names names() const
  {
    Names names;
    for (const auto& entry : fs::directory_iterator(this->folder()))
    {
      names.insert(entry.path().filename());
    }
    return names;
  }
};

/// A process of its own that opens files, and then waits to be killed.
class Other
{
public:
  explicit Other(const std::function<void()>& work)
  {
    int ready[2] = {};
    EXPECT_EQ(::pipe(ready), 0);
    child_ = ::fork();
    if (child_ == 0)
    {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      work();
      static_cast<void>(!::write(ready[1], "x", 1));
      for (;;)
      {
        ::pause();
      }
    }
    char got = 0;
    EXPECT_EQ(::read(ready[0], &got, 1), 1);
    ::close(ready[0]);
    ::close(ready[1]);
  }
  Other(const Other&) = delete;
  Other& operator=(const Other&) = delete;
  ~Other() { this->kill(); }

  void kill()
  {
    if (child_ > 0)
    {
      EXPECT_EQ(::kill(child_, SIGKILL), 0);
      EXPECT_EQ(::waitpid(child_, nullptr, 0), child_);
    }
    child_ = -1;
  }

private:
  pid_t child_ = -1;
};

/// Files that the process keeps open until it ends.
NewFile& keep(const std::string& path, Locking locking = Locking::Own)
{
  auto* const file = new NewFile(path, locking);
  file->write_at(0, "half of new");
  return *file;
}
}

TEST_F(LeftFiles, TheNameStandsForTheTarget)
{
  const NewFile a(this->path("a"));
  const NewFile again(this->path("a"));
  const NewFile b(this->path("b"));
  const std::string name = fs::path(a.temporary_name()).filename();
  EXPECT_EQ(name.size(), std::string(".granular-0123456789abcdef-0.tmp").size()) << name;
  EXPECT_EQ(name.rfind(".granular-", 0), 0u) << name;
  EXPECT_EQ(fs::path(a.temporary_name()).parent_path(), this->folder());
  const auto hash = [](const NewFile& file)
  { return fs::path(file.temporary_name()).filename().string().substr(10, 16); };
  EXPECT_EQ(hash(again), hash(a));
  EXPECT_NE(hash(b), hash(a));
  EXPECT_NE(again.temporary_name(), a.temporary_name());
}

TEST_F(LeftFiles, ANameOf255Bytes)
{
  const std::string longest(255, 'x');
  write_file(this->path(longest), "bytes");
  EXPECT_EQ(this->names(), Names{ longest });
}

TEST_F(LeftFiles, AKilledProgramLeavesTheOldFileAndTheNextWriteRemovesTheRest)
{
  for (const Locking locking : { Locking::Own, Locking::Others })
  {
    write_file(this->path("a"), "old");
    {
      Other other([&] { keep(this->path("a"), locking); });
      other.kill();
    }
    EXPECT_EQ(this->content("a"), "old");
    EXPECT_EQ(this->names().size(), locking == Locking::Own ? 2u : 3u);
    write_file(this->path("b"), "not the same file");
    EXPECT_EQ(this->names().size(), locking == Locking::Own ? 3u : 4u);
    write_file(this->path("a"), "newer", false);
    EXPECT_EQ(this->content("a"), "newer");
    EXPECT_EQ(this->names(), (Names{ "a", "b" }));
    fs::remove(this->path("b"));
  }
}

TEST_F(LeftFiles, ThatOfALiveProgramStays)
{
  for (const Locking locking : { Locking::Own, Locking::Others })
  {
    Other other([&] { keep(this->path("a"), locking); });
    const Names before = this->names();
    write_file(this->path("a"), "bytes");
    {
      const NewFile here(this->path("a"), locking);
      write_file(this->path("a"), "bytes again");
    }
    Names expected = before;
    expected.insert("a");
    EXPECT_EQ(this->names(), expected);
    other.kill();
    write_file(this->path("a"), "last");
    EXPECT_EQ(this->names(), Names{ "a" });
  }
}

/// A program that goes on keeps its file from the removal until that has its name.
TEST_F(LeftFiles, ThatOfAThreadStays)
{
  NewFile first(this->path("a"));
  first.write_at(0, "first");
  for (int i = 0; i < 3; ++i)
  {
    write_file(this->path("a"), "second");
  }
  EXPECT_TRUE(fs::exists(first.temporary_name()));
  first.finish(true);
  EXPECT_EQ(this->content("a"), "first");
  EXPECT_EQ(this->names(), Names{ "a" });
}

TEST_F(LeftFiles, ThoseOfManyAreRemovedAlthoughSomeOfThemEnded)
{
  {
    Other other(
      [&]
      {
        std::vector<NewFile*> files;
        for (int i = 0; i < 40; ++i)
        {
          files.push_back(&keep(this->path("a"), i % 3 == 0 ? Locking::Others : Locking::Own));
        }
        for (const int ended : { 0, 1, 2, 3, 10, 11, 12, 13, 14, 15, 16, 38 })
        {
          delete files[static_cast<std::size_t>(ended)];
        }
      });
    EXPECT_GT(this->names().size(), 28u);
  }
  write_file(this->path("a"), "bytes");
  EXPECT_EQ(this->names(), Names{ "a" });
}

/// Nothing is removed that no writer of the user can have left.
TEST_F(LeftFiles, WhatIsNotOursStays)
{
  std::vector<std::string> found;
  {
    std::vector<std::unique_ptr<NewFile>> files;
    for (int i = 0; i < 4; ++i)
    {
      files.push_back(std::make_unique<NewFile>(this->path("a")));
      found.push_back(fs::path(files.back()->temporary_name()).filename());
    }
  }
  write_file(this->path("mine"), "mine");
  fs::create_symlink("mine", this->path(found[0]));
  ASSERT_EQ(::mkfifo(this->path(found[1]).c_str(), 0666), 0);
  fs::create_directory(this->path(found[2]));
  Names expected = { "a", "mine", found[0], found[1], found[2] };
  if (::geteuid() == 0)
  {
    write_file(this->path(found[3]), "another's");
    ASSERT_EQ(::chown(this->path(found[3]).c_str(), 65534, 65534), 0);
    expected.insert(found[3]);
  }
  const std::string like = ".granular-0123456789abcdef-0.tmp"; // of another target
  write_file(this->path(like), "x");
  expected.insert(like);
  write_file(this->path("a"), "bytes");
  EXPECT_EQ(this->content("a"), "bytes");
  EXPECT_EQ(this->names(), expected);
  EXPECT_EQ(this->content("mine"), "mine");
}

/// Who has no name any more gives none to what is there instead.
TEST_F(LeftFiles, ARemovedFileIsAnErrorAndTheOldFileStays)
{
  for (const Locking locking : { Locking::Own, Locking::Others })
  {
    write_file(this->path("a"), "old");
    NewFile file(this->path("a"), locking);
    for (const std::string& name : this->names())
    {
      if (name != "a")
      {
        fs::remove(this->path(name));
      }
    }
    NewFile next(this->path("a"), locking);
    next.write_at(0, "half");
    EXPECT_THROW(file.finish(true), granular::IoError);
    EXPECT_EQ(this->content("a"), "old");
  }
}

/// Many programs write one file, and some are killed: it is always that of one of them, and whole.
TEST_F(LeftFiles, ManyProgramsOfWhichSomeAreKilled)
{
  constexpr std::size_t bytes = 100'000;
  constexpr int programs = 6;
  write_file(this->path("a"), std::string(bytes, 'a'), false);
  std::mt19937 random(1);
  std::vector<pid_t> children;
  const auto start = [&](int number)
  {
    const pid_t child = ::fork();
    if (child == 0)
    {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL); // a failed test leaves none of them
      try
      {
        const std::string content(bytes, static_cast<char>('b' + number % 20));
        for (;;)
        {
          write_file(this->path("a"), content, false);
        }
      }
      catch (const std::exception&)
      {
        ::_exit(1);
      }
    }
    return child;
  };
  for (int i = 0; i < programs; ++i)
  {
    children.push_back(start(i));
  }
  for (int i = 0; i < 100; ++i)
  {
    ::usleep(static_cast<useconds_t>(random() % 4000));
    pid_t& child = children[random() % programs];
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "a writer has failed";
    const std::string now = this->content("a");
    ASSERT_EQ(now.size(), bytes);
    ASSERT_EQ(std::count(now.begin(), now.end(), now[0]), static_cast<std::ptrdiff_t>(bytes));
    child = start(i);
  }
  for (const pid_t child : children)
  {
    ASSERT_EQ(::kill(child, SIGKILL), 0);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  }
  write_file(this->path("a"), "last");
  EXPECT_EQ(this->names(), Names{ "a" });
}
