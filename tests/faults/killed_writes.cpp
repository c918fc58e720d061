// SPDX-License-Identifier: BSD-3-Clause
// Writers that are killed at any moment: the old or the new file is whole, and the next write leaves nothing of them.
// GRANULAR_KILLS: the number of random moments.
#include "../c/handles.h"
#include "../support/dying_calls.h"
#include "../support/own_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace
{
namespace fs = std::filesystem;

/// What is written: frames of a file of a real run, again and again.
struct Kind
{
  const char* name;
  const char* source;
  const char* target;
  int times;
};

constexpr Kind kinds[] = {
  { "text", "grains.dump", "a.dump", 2 },
  { "gzip", "grains.dump", "a.dump.gz", 1 },
  { "Zstandard", "grains.dump", "a.dump.zst", 1 },
  { "binary", "grains.dump", "a.bin", 2 },
  { "a file for each frame", "grains.dump", "a_*.dump", 1 },
  { "contacts", "local/contacts.dump", "a.bonds", 1 },
  { "cells", "euler_1000.vtk", "a.euler", 1 },
  { "subdomains", "decomposition_1000.vtk", "a.decomposition", 1 },
};

/// The frames of the source, read once.
class Frames
{
public:
  explicit Frames(const Kind& kind)
    : kind_(kind)
    , run_(open_run(good(kind.source)))
  {
    granular_run_facts facts = {};
    EXPECT_EQ(granular_run_info(run_.get(), &facts), GRANULAR_OK) << message();
    for (std::int64_t number = 0; number < facts.frames; ++number)
    {
      frames_.push_back(read_frame(run_, number));
    }
  }

  /// False after an error.
  bool write(const std::string& folder, bool durable) const
  {
    granular_format format;
    granular_format_init(&format);
    format.threads = 2;
    format.durable = durable ? 1 : 0;
    granular_writer* writer = nullptr;
    bool done =
      granular_create((folder + "/" + kind_.target).c_str(), &format, &writer) == GRANULAR_OK;
    for (int i = 0; i < kind_.times && done; ++i)
    {
      for (const FrameHandle& frame : frames_)
      {
        done = done && granular_write_frame(writer, frame.get()) == GRANULAR_OK;
      }
    }
    return done && granular_finish(writer) == GRANULAR_OK;
  }

private:
  const Kind& kind_;
  RunHandle run_;
  std::vector<FrameHandle> frames_;
};

/// The names and contents of all files of a folder, hidden ones too.
std::map<std::string, std::string> files_of(const std::string& folder)
{
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
  {
    files[entry.path().filename()] = content(entry.path());
  }
  return files;
}

/// A kind of file, and the folder with the old files.
class KilledWriter
{
public:
  KilledWriter(const Kind& kind, std::string folder)
    : frames_(kind)
    , folder_(std::move(folder))
  {
    fs::create_directories(folder_);
    EXPECT_TRUE(frames_.write(folder_, false)) << message();
    all_ = files_of(folder_);
    EXPECT_FALSE(all_.empty());
  }

  /// Writes in a process of its own, which does something before, and is killed after some time. Returns true if it was killed
  /// while it wrote.
  template <class Before>
  bool write(bool durable, const Before& before, int microseconds = -1)
  {
    for (const auto& [name, bytes] : all_)
    {
      std::ofstream(folder_ + "/" + name, std::ios::binary | std::ios::trunc) << old_bytes;
    }
    const pid_t child = ::fork();
    EXPECT_GE(child, 0);
    if (child == 0)
    {
      before();
      ::_exit(frames_.write(folder_, durable) ? 0 : 1);
    }
    if (microseconds >= 0)
    {
      ::usleep(static_cast<useconds_t>(microseconds));
      ::kill(child, SIGKILL);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status) ? WTERMSIG(status) == SIGKILL : WEXITSTATUS(status) == 0);
    return WIFSIGNALED(status);
  }

  /// Each file is the old or the new one; at most one other is there, and none after the next write.
  void check()
  {
    int left = 0;
    for (const auto& [name, bytes] : files_of(folder_))
    {
      const auto found = all_.find(name);
      if (found == all_.end())
      {
        ++left;
        EXPECT_EQ(name.rfind(".granular-", 0), 0u) << name;
        for (const char* const ending : { "", ".locktest.0", "-7-8.lock" }) // as of Open MPI
        {
          std::ofstream(folder_ + "/" + name + ".data" + ending);
        }
      }
      else
      {
        EXPECT_TRUE(bytes == old_bytes || bytes == found->second)
          << name << " is neither old nor new";
      }
    }
    EXPECT_LE(left, 1);
    seen_left_ += left;
    EXPECT_TRUE(frames_.write(folder_, false)) << message();
    EXPECT_TRUE(files_of(folder_) == all_);
  }

  int seen_left() const { return seen_left_; }

private:
  const std::string old_bytes = std::string(300'000, 'o'); ///< of each file before
  Frames frames_;
  std::string folder_;
  std::map<std::string, std::string> all_; ///< files when all is written
  int seen_left_ = 0;
};

class KilledWrites : public OwnFolder
{
};
}

TEST_F(KilledWrites, AtEachCallOfTheSystem)
{
  for (const Kind& kind : kinds)
  {
    for (const bool durable : { false, true })
    {
      SCOPED_TRACE(kind.name);
      KilledWriter writer(kind, this->path(kind.name + std::string(durable ? " durable" : "")));
      int calls = 1;
      for (; writer.write(durable, [&] { die_at_call(calls); }); ++calls)
      {
        writer.check();
        ASSERT_FALSE(HasFailure()) << "killed at call " << calls;
      }
      EXPECT_GT(calls, 10);
      EXPECT_GT(writer.seen_left(), 3);
      this->RecordProperty(std::string(kind.name) + (durable ? " durable" : ""), calls - 1);
    }
  }
}

TEST_F(KilledWrites, AtRandomMoments)
{
  const char* const given = std::getenv("GRANULAR_KILLS");
  const int kills = given != nullptr ? std::atoi(given) : 300;
  const char* const seed = std::getenv("GRANULAR_SEED");
  std::mt19937 random(static_cast<unsigned>(seed != nullptr ? std::atoi(seed) : 1));
  int killed = 0;
  int left = 0;
  const int each = kills / static_cast<int>(std::size(kinds)) + 1;
  for (const Kind& kind : kinds)
  {
    SCOPED_TRACE(kind.name);
    KilledWriter writer(kind, this->path(kind.name));
    const auto begin = std::chrono::steady_clock::now();
    writer.write(true, [] {});
    const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
    std::uniform_int_distribution<int> moment(0, static_cast<int>(time.count()));
    for (int tries = 0; tries < each || (killed == 0 && tries < 20 * each); ++tries)
    {
      const bool durable = random() % 2 == 0;
      if (writer.write(
            durable, [] {}, moment(random)))
      {
        ++killed;
        writer.check();
        ASSERT_FALSE(HasFailure()) << "killed at moment " << tries;
      }
    }
    left += writer.seen_left();
  }
  EXPECT_GT(killed, 0);
  std::cout << "killed at " << killed << " of " << each * static_cast<int>(std::size(kinds))
            << " moments, of which " << left << " left a file\n";
}
