// SPDX-License-Identifier: BSD-3-Clause
// Writers that are killed at any moment: the old or the new file is whole, and the next write leaves nothing of them.
// GRANULAR_KILLS: the number of random moments.
#include "../support/dying_calls.h"
#include "../support/own_folder.h"
#include "runs.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <random>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

using namespace runs;

namespace
{
/// A file of a kind, or a series, and the folder with the old files.
class KilledWriter
{
public:
  KilledWriter(const std::string& source, std::string folder, const std::string& name)
    : frames_(good(source))
    , folder_(std::move(folder))
    , path_(folder_ + "/" + name)
  {
    fs::create_directories(folder_);
    this->write_all(false);
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
      ::_exit(this->write_all(durable) ? 0 : 1);
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
    EXPECT_TRUE(this->write_all(false)) << message();
    EXPECT_TRUE(files_of(folder_) == all_);
  }

  int seen_left() const { return seen_left_; }

private:
  bool write_all(bool durable) const
  {
    granular_format format;
    granular_format_init(&format);
    format.threads = 2;
    format.durable = durable ? 1 : 0;
    return frames_.write(path_, format) == GRANULAR_OK;
  }

  const std::string old_bytes = std::string(300'000, 'o'); ///< of each file before
  Frames frames_;
  std::string folder_;
  std::string path_;
  std::map<std::string, std::string> all_; ///< files when all is written
  int seen_left_ = 0;
};

class KilledWrites : public OwnFolder
{
protected:
  /// Calls use(writer) for each kind of file, and for a series.
  template <class Use>
  void for_each_kind(const Use& use)
  {
    for (const Output& output : outputs)
    {
      SCOPED_TRACE(output.name);
      KilledWriter writer(output.file, this->path(output.name), std::string("a") + output.ending);
      use(writer);
    }
    KilledWriter series("grains.dump", this->path("series"), "a_*.dump");
    use(series);
  }
};
}

TEST_F(KilledWrites, AtEachCallOfTheSystem)
{
  this->for_each_kind(
    [&](KilledWriter& writer)
    {
      int calls = 1;
      for (; writer.write(true, [&] { die_at_call(calls); }); ++calls)
      {
        writer.check();
        ASSERT_FALSE(HasFailure()) << "killed at call " << calls;
      }
      EXPECT_GT(calls, 10);
      EXPECT_GT(writer.seen_left(), 3);
    });
}

TEST_F(KilledWrites, AtRandomMoments)
{
  const char* const given = std::getenv("GRANULAR_KILLS");
  const int kills = given != nullptr ? std::atoi(given) : 300;
  const char* const seed = std::getenv("GRANULAR_SEED");
  std::mt19937 random(static_cast<unsigned>(seed != nullptr ? std::atoi(seed) : 1));
  int killed = 0;
  int left = 0;
  this->for_each_kind(
    [&](KilledWriter& writer)
    {
      const auto begin = std::chrono::steady_clock::now();
      writer.write(true, [] {});
      const std::chrono::duration<double, std::micro> time =
        std::chrono::steady_clock::now() - begin;
      std::uniform_int_distribution<int> moment(0, static_cast<int>(time.count()));
      for (int tries = 0; tries < kills / 10; ++tries)
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
    });
  EXPECT_GT(killed, 0);
  std::cout << "killed at " << killed << " moments, " << left << " left a file\n";
}
