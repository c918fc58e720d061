// SPDX-License-Identifier: BSD-3-Clause
#include "dying_calls.h"

#include <atomic>
#include <csignal>
#include <cstdarg>
#include <cstddef>
#include <cstdio>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

namespace
{
std::atomic<long> left = 0; ///< calls until that one; 0 and below: none

void die()
{
  ::kill(::getpid(), SIGKILL);
}

bool is_last()
{
  return left > 0 && --left == 0;
}

/// Makes a call of the system, unless it is the last.
template <class Function, class... Arguments>
auto call(const char* name, Arguments... arguments)
{
  if (is_last())
  {
    die();
  }
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name))(arguments...);
}
}

void die_at_call(long number)
{
  left = number;
}

long calls_before_death()
{
  return left;
}

// NOLINTBEGIN: the names and types are those of the system
#pragma GCC visibility push(default) // shared libraries are to find them
extern "C"
{
  void granular_die_at_call(long number)
  {
    die_at_call(number);
  }

  int open(const char* path, int flags, ...)
  {
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return call<int(const char*, int, ...)>("open", path, flags, mode);
  }

  ssize_t pwrite(int file, const void* bytes, size_t count, off_t offset)
  {
    auto* const write =
      reinterpret_cast<ssize_t (*)(int, const void*, size_t, off_t)>(::dlsym(RTLD_NEXT, "pwrite"));
    if (is_last())
    {
      [[maybe_unused]] const ssize_t half = write(file, bytes, count / 2, offset);
      die();
    }
    return write(file, bytes, count, offset);
  }

  int flock(int file, int operation) noexcept
  {
    return call<int(int, int)>("flock", file, operation);
  }

  int fsync(int file)
  {
    return call<int(int)>("fsync", file);
  }

  int fchmod(int file, mode_t mode) noexcept
  {
    return call<int(int, mode_t)>("fchmod", file, mode);
  }

  int rename(const char* from, const char* to) noexcept
  {
    return call<int(const char*, const char*)>("rename", from, to);
  }

  int unlink(const char* path) noexcept
  {
    return call<int(const char*)>("unlink", path);
  }

  int close(int file)
  {
    return call<int(int)>("close", file);
  }
}
#pragma GCC visibility pop
// NOLINTEND
