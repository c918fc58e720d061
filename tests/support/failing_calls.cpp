// SPDX-License-Identifier: BSD-3-Clause
#include "failing_calls.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <string>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

namespace
{
enum class Call
{
  Open,
  Stat,
  Read
};

FailingCalls failing;
std::atomic<long> counted = 0;
std::atomic<long> made = 0;

bool may_fail(Call call, CallFault fault)
{
  const bool of_all = fault == CallFault::Error;
  const bool of_opening = fault == CallFault::Interrupted;
  return fault != CallFault::None &&
    (call == Call::Read || of_all || (of_opening && call == Call::Open));
}

/// Which fault this call has.
CallFault next_fault(Call call)
{
  ++made;
  if (!may_fail(call, failing.fault))
  {
    return CallFault::None;
  }
  const long number = ++counted - failing.first;
  return number >= 0 && number < failing.count ? failing.fault : CallFault::None;
}

/// Sets errno as the fault says; false: the call is made.
bool fails(CallFault fault)
{
  errno = fault == CallFault::Interrupted ? EINTR : fault == CallFault::Error ? EIO : errno;
  return fault == CallFault::Interrupted || fault == CallFault::Error;
}

template <class Function>
Function* of_system(const char* name)
{
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

/// What a read gives in place of what there is.
void change(char* bytes, std::size_t count, CallFault fault)
{
  switch (fault)
  {
    case CallFault::Zeros:
      std::fill_n(bytes, count, '\0');
      break;
    case CallFault::Ones:
      std::fill_n(bytes, count, '\xff');
      break;
    case CallFault::Letters:
      std::fill_n(bytes, count, 'x');
      break;
    case CallFault::Moved:
      std::reverse(bytes, bytes + count);
      break;
    default:
      break;
  }
}

void cut_in_two(int file)
{
  struct stat status;
  const std::string path = "/proc/self/fd/" + std::to_string(file);
  if (of_system<int(int, struct stat*)>("fstat")(file, &status) == 0)
  {
    [[maybe_unused]] const int done = ::truncate(path.c_str(), status.st_size / 2);
  }
}
}

void make_fail(const FailingCalls& calls)
{
  failing = calls;
  counted = 0;
  made = 0;
}

long calls_that_may_fail()
{
  return counted;
}

long all_calls()
{
  return made;
}

// NOLINTBEGIN: the names and types are those of the system
#pragma GCC visibility push(default) // shared libraries are to find them
extern "C"
{
  ssize_t pread(int file, void* buffer, size_t bytes, off_t offset)
  {
    static auto* const read = of_system<ssize_t(int, void*, size_t, off_t)>("pread");
    const CallFault fault = next_fault(Call::Read);
    if (fault == CallFault::Shortened)
    {
      cut_in_two(file);
    }
    if (fails(fault))
    {
      return -1;
    }
    const size_t most = fault == CallFault::End ? 0 : fault == CallFault::Short ? 1 : bytes;
    const ssize_t got = read(file, buffer, std::min(bytes, most), offset);
    change(static_cast<char*>(buffer), got > 0 ? static_cast<size_t>(got) : 0, fault);
    return got;
  }

  int open(const char* path, int flags, ...)
  {
    static auto* const open_file = of_system<int(const char*, int, ...)>("open");
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    const bool reads = (flags & O_ACCMODE) == O_RDONLY && (flags & O_DIRECTORY) == 0;
    return reads && fails(next_fault(Call::Open)) ? -1 : open_file(path, flags, mode);
  }

  int fstat(int file, struct stat* status) noexcept
  {
    static auto* const ask = of_system<int(int, struct stat*)>("fstat");
    return fails(next_fault(Call::Stat)) ? -1 : ask(file, status);
  }

  int stat(const char* path, struct stat* status) noexcept
  {
    static auto* const ask = of_system<int(const char*, struct stat*)>("stat");
    return fails(next_fault(Call::Stat)) ? -1 : ask(path, status);
  }
}
#pragma GCC visibility pop
// NOLINTEND
