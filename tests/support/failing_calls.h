// SPDX-License-Identifier: BSD-3-Clause
// Makes calls of the system fail: those that open, ask, read and write files, take memory and start threads. A program that has
// failing_calls.cpp among its sources makes these calls in place of the system's, and so do the libraries that it uses; memory
// needs failing_memory.cpp as well. As a library for LD_PRELOAD, the two do the same for any program.
#ifndef granular_tests_support_failing_calls_h
#define granular_tests_support_failing_calls_h

#include <cerrno>
#include <limits>

/// What becomes of a call.
enum class CallFault
{
  None,
  Short,       ///< one byte is read or written
  Interrupted, ///< EINTR; of calls that know it
  End,         ///< a read gives nothing, as at the end of the file
  Shortened,   ///< the file is cut in two before the read
  Zeros,       ///< a read gives other bytes: zeros
  Ones,        ///< bits that are all set
  Letters,     ///< x
  Moved,       ///< the bytes in the other order
  Error        ///< FailingCalls::error of any call
};

/// Kinds of calls, which may be added.
namespace calls
{
constexpr unsigned open = 1;     ///< of a file to read
constexpr unsigned stat = 2;     ///< fstat, stat, lstat, access, faccessat
constexpr unsigned read = 4;     ///< read, pread
constexpr unsigned create = 8;   ///< open of a file to write, and mkdir
constexpr unsigned write = 16;   ///< write, pwrite, pwritev
constexpr unsigned close = 32;   ///< which closes nevertheless
constexpr unsigned rename = 64;  ///< rename, link
constexpr unsigned unlink = 128; ///< unlink
constexpr unsigned change = 256; ///< fchmod, chmod, ftruncate
constexpr unsigned sync = 512;   ///< fsync, fdatasync
constexpr unsigned memory =
  1024; ///< malloc, calloc, realloc, aligned memory, and new, which needs these
constexpr unsigned map = 2048;    ///< mmap of memory without a file
constexpr unsigned thread = 4096; ///< pthread_create
constexpr unsigned lock = 8192;   ///< flock
constexpr unsigned copy = 16384;  ///< fcntl that copies a descriptor
constexpr unsigned reading = open | stat | read;
}

/// Which calls fail: `count` of them from call `first` on, where each call counts that may have such a fault.
struct FailingCalls
{
  static constexpr long always = std::numeric_limits<long>::max();

  CallFault fault = CallFault::None;
  long first = 1;
  long count = 1;
  unsigned kinds = calls::reading;
  int error = EIO;
  const char* folder = nullptr; ///< only files whose path has this in it
  const char* caller =
    nullptr; ///< only memory that a program or library with this in its name asked for
};

/// From now on; calls are counted anew. The strings must stay.
void make_fail(const FailingCalls& calls);

/// No call fails any more; what was counted stays.
void stop_failing();

/// Returns how many calls there were since make_fail: those that could fail so, or all that read.
long calls_that_may_fail();
long all_calls();

/// Returns the blocks of memory that were taken and not yet given back, if failing_memory.cpp is there.
long live_blocks();

/// Returns how many files this process has open.
long open_files();

// What failing_calls.cpp and failing_memory.cpp share.
namespace failing_calls
{
/// Returns the fault of a call of a kind, for a file or a path if it has one.
CallFault next_fault(unsigned kind, int file = -1, const char* path = nullptr) noexcept;

/// Returns true, and sets errno, if a call of a kind fails that knows no other fault than an error.
bool refuses(unsigned kind) noexcept;

/// Returns false if no call of a kind fails now.
bool may_refuse(unsigned kind) noexcept;

/// The caller that FailingCalls asks for.
const char* wanted_caller() noexcept;
}
#endif
