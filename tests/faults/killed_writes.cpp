// SPDX-License-Identifier: BSD-3-Clause
// Writers that are killed at each call of the system: the old or the new file is whole, and the next write leaves nothing of them.
#include "../support/dying_calls.h"
#include "../support/own_folder.h"
#include "runs.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <iterator>
#include <map>
#include <string>
#include <vector>

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
    this->write_all();
    all_ = files_of(folder_);
    EXPECT_FALSE(all_.empty());
  }

  /// Writes in a process of its own, which is killed at a call. Returns false if it came to its end.
  bool write_until(long call)
  {
    for (const auto& [name, bytes] : all_)
    {
      std::ofstream(folder_ + "/" + name, std::ios::binary | std::ios::trunc) << old_bytes;
    }
    const pid_t child = ::fork();
    EXPECT_GE(child, 0);
    if (child == 0)
    {
      die_at_call(call);
      ::_exit(this->write_all() ? 0 : 1);
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
    EXPECT_TRUE(this->write_all()) << message();
    EXPECT_TRUE(files_of(folder_) == all_);
  }

  int seen_left() const { return seen_left_; }

private:
  bool write_all() const
  {
    granular_format format;
    granular_format_init(&format);
    format.threads = 2;
    format.durable = 1;
    return frames_.write(path_, format) == GRANULAR_OK;
  }

  const std::string old_bytes = std::string(300'000, 'o'); ///< of each file before
  Frames frames_;
  std::string folder_;
  std::string path_;
  std::map<std::string, std::string> all_; ///< files when all is written
  int seen_left_ = 0;
};

using KilledWrites = OwnFolder;
}

TEST_F(KilledWrites, LeaveTheOldFileOrTheNewOne)
{
  std::vector<Output> files(std::begin(outputs), std::end(outputs));
  files.push_back({ "series", "grains.dump", "_*.dump" });
  for (const Output& output : files)
  {
    SCOPED_TRACE(output.name);
    KilledWriter writer(output.file, this->path(output.name), std::string("a") + output.ending);
    long calls = 1;
    for (; writer.write_until(calls); ++calls)
    {
      writer.check();
      ASSERT_FALSE(HasFailure()) << "killed at call " << calls;
    }
    EXPECT_GT(calls, 10);
    EXPECT_GT(writer.seen_left(), 3);
  }
}
