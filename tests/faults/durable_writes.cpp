// SPDX-License-Identifier: BSD-3-Clause
// Files that survive a loss of power: what waits for the disk, and what an error of the disk leaves.
#include "../support/failing_calls.h"
#include "../support/own_folder.h"
#include "../support/write_file.h"
#include "runs.h"

#include "granular/bytes/byte_sink.h"
#include "granular/common/error.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>

namespace
{
namespace fs = std::filesystem;

class DurableWrites : public OwnFolder
{
protected:
  void SetUp() override
  {
    OwnFolder::SetUp();
    write_file(this->path("a"), "old", true);
  }

  void TearDown() override { stop_failing(); }

  /// The synchronisation of this number fails; returns what was said, and "" if all was well.
  std::string write(bool durable, int error, long number = 1)
  {
    make_fail({ CallFault::Error, number, 1, calls::sync, error });
    std::string said;
    try
    {
      write_file(this->path("a"), "new", durable);
    }
    catch (const granular::IoError& failed)
    {
      said = failed.what();
      EXPECT_EQ(failed.code(), static_cast<std::errc>(error));
    }
    stop_failing();
    EXPECT_EQ(std::distance(fs::directory_iterator(this->folder()), {}), 1);
    return said;
  }

  /// How often a file of this name waits for the disk.
  long syncs(const std::string& name, const granular_format& format)
  {
    const runs::Frames frames(good("grains_1000.dump"));
    make_fail({ CallFault::Error, FailingCalls::always, 1, calls::sync });
    EXPECT_EQ(frames.write(this->path(name), format), GRANULAR_OK) << message();
    return calls_that_may_fail();
  }
};
}

TEST_F(DurableWrites, TheFileIsOnTheDiskBeforeItHasItsName)
{
  EXPECT_EQ(this->write(true, EIO), this->path("a") + ": cannot write: Input/output error");
  EXPECT_EQ(content(this->path("a")), "old");
  EXPECT_EQ(this->write(true, ENOSPC), this->path("a") + ": cannot write: No space left on device");
  EXPECT_EQ(content(this->path("a")), "old");
}

TEST_F(DurableWrites, TheNameIsOnTheDiskAfterwards)
{
  EXPECT_EQ(this->write(true, EIO, 2),
    this->path("a") +
      ": written, but a loss of power may take the new file back: cannot synchronise its folder: "
      "Input/output error");
  EXPECT_EQ(content(this->path("a")), "new");
}

TEST_F(DurableWrites, WithoutThereIsNoWaiting)
{
  EXPECT_EQ(this->write(false, EIO), "");
  EXPECT_EQ(calls_that_may_fail(), 0);
  EXPECT_EQ(content(this->path("a")), "new");
}

TEST_F(DurableWrites, AFileSystemThatCannotTellIsNoError)
{
  for (const int error : { EINVAL, ENOTSUP, ENOSYS })
  {
    for (const long number : { 1, 2 })
    {
      EXPECT_EQ(this->write(true, error, number), "");
      EXPECT_EQ(content(this->path("a")), "new");
    }
  }
}

TEST_F(DurableWrites, OneFileWaitsAndASeriesDoesNot)
{
  granular_format format;
  granular_format_init(&format); // automatic
  EXPECT_EQ(this->syncs("one.dump", format), 2);
  EXPECT_EQ(this->syncs("one.dump.gz", format), 2);
  EXPECT_EQ(this->syncs("many_*.dump", format), 0);
  format.durable = 0;
  EXPECT_EQ(this->syncs("one.dump", format), 0);
  format.durable = 1;
  EXPECT_EQ(this->syncs("many_*.dump", format), 2);
  format.durable = 3;
  granular_writer* writer = nullptr;
  for (const char* const style : { "custom", "euler" })
  {
    format.style = style;
    EXPECT_EQ(granular_create(this->path("a").c_str(), &format, &writer), GRANULAR_BAD_ARGUMENT);
    EXPECT_EQ(message(), "expected durable of 0, 1 or 2 (automatic), got 3");
  }
}
