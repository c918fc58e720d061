// SPDX-License-Identifier: BSD-3-Clause
// The calls of the system that fail, one after the other, and a check that each has failed: a fault that never comes proves nothing.
#ifndef granular_tests_faults_failing_cases_h
#define granular_tests_faults_failing_cases_h

#include "../support/failing_calls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

/// Hidden files that are there after a fault, until the next writer of the same file.
enum class Leaves
{
  Nothing,
  Own,  ///< that of the writer
  Older ///< that of a writer before it, which had leaving_calls()
};

/// A fault.
struct FailingCase
{
  const char* name;
  unsigned kinds;
  CallFault fault;
  int error = EIO;
  bool harmless = false; ///< nothing may be seen of it
  long count = 1;
  Leaves leaves = Leaves::Nothing;
};

// clang-format off
inline constexpr FailingCase reader_cases[] = {
  { "a file cannot be opened", calls::open, CallFault::Error, EACCES },
  { "opening is interrupted", calls::open, CallFault::Interrupted, EINTR, true },
  { "a file cannot be asked", calls::stat, CallFault::Error },
  { "a read fails", calls::read, CallFault::Error },
  { "a read gives nothing", calls::read, CallFault::End, 0 },
  { "a read gives one byte", calls::read, CallFault::Short, 0, true },
  { "a read is interrupted", calls::read, CallFault::Interrupted, EINTR, true },
  { "closing fails", calls::close, CallFault::Error, EIO, true },
  { "closing is interrupted", calls::close, CallFault::Interrupted, EINTR, true },
  { "memory is refused", calls::memory, CallFault::Error, ENOMEM },
};

inline constexpr FailingCase writer_cases[] = {
  { "a file cannot be asked", calls::stat, CallFault::Error },
  { "no file can be made", calls::create, CallFault::Error, ENOSPC },
  { "making a file is interrupted", calls::create, CallFault::Interrupted, EINTR, true },
  { "the disk is full", calls::write, CallFault::Error, ENOSPC },
  { "a write fails", calls::write, CallFault::Error },
  { "one byte is written", calls::write, CallFault::Short, 0, true },
  { "a write is interrupted", calls::write, CallFault::Interrupted, EINTR, true },
  { "a file cannot be changed", calls::change, CallFault::Error, EPERM },
  { "there are no locks", calls::lock, CallFault::Error, ENOLCK, true, FailingCalls::always },
  { "locking is interrupted", calls::lock, CallFault::Interrupted, EINTR, true },
  { "there are no descriptors", calls::copy, CallFault::Error, EMFILE },
  { "closing fails", calls::close, CallFault::Error, ENOSPC },
  { "closing is interrupted", calls::close, CallFault::Interrupted, EINTR, true },
  { "renaming fails", calls::rename, CallFault::Error, EACCES },
  { "renaming and removing fail", calls::rename | calls::unlink, CallFault::Error, EACCES, false, FailingCalls::always, Leaves::Own },
  { "an older file cannot be removed", calls::unlink, CallFault::Error, EACCES, true, FailingCalls::always, Leaves::Older },
  { "the disk takes nothing", calls::sync, CallFault::Error },
  { "waiting for the disk is interrupted", calls::sync, CallFault::Interrupted, EINTR, true },
  { "the disk cannot wait", calls::sync, CallFault::Error, EINVAL, true },
  { "the disk knows no waiting", calls::sync, CallFault::Error, ENOTSUP, true },
  { "the system knows no waiting", calls::sync, CallFault::Error, ENOSYS, true },
  { "memory is refused", calls::memory, CallFault::Error, ENOMEM },
};

/// Small inputs need neither.
inline constexpr FailingCase large_cases[] = {
  { "pages are refused", calls::map, CallFault::Error, ENOMEM },
  { "a thread is refused", calls::thread, CallFault::Error, EAGAIN, true },
};
// clang-format on

inline bool of_memory(const FailingCase& one)
{
  return (one.kinds & (calls::memory | calls::map)) != 0;
}

inline FailingCalls failing_calls_of(const FailingCase& one, long number, const std::string& folder)
{
  FailingCalls calls = { one.fault, number, one.count, one.kinds, one.error };
  calls.folder = folder.c_str();
  return calls;
}

/// What lets a writer leave its hidden file behind, as one does that is killed.
inline FailingCalls leaving_calls(const std::string& folder)
{
  FailingCalls calls = { CallFault::Error, 1, FailingCalls::always, calls::rename | calls::unlink,
    EACCES };
  calls.folder = folder.c_str();
  return calls;
}

/// A folder as it is in the paths of its open files and of itself.
inline std::string without_slash(std::string folder)
{
  while (folder.ends_with('/'))
  {
    folder.pop_back();
  }
  return folder;
}

inline bool is_hidden(const std::string& name)
{
  return name.starts_with(".granular-");
}

/// How many hidden files of writers a folder has.
inline long count_hidden(const std::string& folder)
{
  return std::ranges::count_if(std::filesystem::directory_iterator(folder),
    [](const auto& entry) { return is_hidden(entry.path().filename().string()); });
}

/// Expects that a case came up in this test.
inline void expect_delivered(const char* case_name, long delivered)
{
  EXPECT_TRUE(testing::Test::HasFailure() || delivered > 0) << case_name << " never came up";
}

/// The calls that fail in turn: the first, the last and about `most` between them, which begin at another one each time. With
/// GRANULAR_FAULTS=all in the environment: all.
struct Turns
{
  Turns(long most, const std::function<long(long number)>& use)
  {
    static long begun = 0;
    const char* const wanted = std::getenv("GRANULAR_FAULTS");
    if (wanted == nullptr || std::string_view(wanted) != "all")
    {
      last = use(FailingCalls::always);
      step = std::max(1L, last / most) | 1; // odd, as calls often come in pairs
      second = 2 + begun++ % step;
    }
  }

  long after(long number) const
  {
    return number < last ? std::min(number == 1 ? second : number + step, last) : last + 1;
  }

  long last = FailingCalls::always;
  long step = 1;
  long second = 2;
};

/// Calls use(number), which lets that call fail, for each of the Turns until it returns fewer calls than that. Files and memory must be
/// as many after it as before: something may be kept for good, but not each time. Returns how many faults there were.
inline long fail_each(const char* name, long most, const std::function<long(long number)>& use)
{
  constexpr int most_tries = 3;
  const Turns turns(most, use);
  long delivered = 0;
  bool fired = true;
  for (long number = 1; fired && number <= turns.last && !testing::Test::HasFailure();
       number = turns.after(number))
  {
    SCOPED_TRACE(std::string(name) + ", call " + std::to_string(number));
    const long files = open_files();
    long possible = 0;
    bool grown = true;
    for (int tries = 0; grown && tries < most_tries; ++tries)
    {
      const long blocks = live_blocks();
      possible = use(number);
      grown = live_blocks() > blocks;
    }
    EXPECT_FALSE(grown && !testing::Test::HasFailure()) << "memory is lost";
    EXPECT_EQ(open_files(), files) << "files are left open";
    fired = possible >= number;
    delivered += fired ? 1 : 0;
  }
  return delivered;
}

/// A dump whose rows are enough for pages of their own.
inline std::string dump_of_rows(long rows)
{
  std::string text = "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n" + std::to_string(rows) +
    "\nITEM: BOX BOUNDS pp pp pp\n0 10\n0 10\n0 10\nITEM: ATOMS id type x y z\n";
  for (long row = 0; row < rows; ++row)
  {
    const std::string digit = std::to_string(row % 9 + 1);
    text += std::to_string(rows - row) + " " + digit + " " + digit + " 2 3\n";
  }
  return text;
}
#endif
