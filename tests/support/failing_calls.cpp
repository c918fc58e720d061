// SPDX-License-Identifier: BSD-3-Clause
#include "failing_calls.h"

#include <algorithm>
#include <atomic>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <string>

#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

namespace
{
FailingCalls failing;
std::atomic<long> counted = 0;
std::atomic<long> made = 0;

/// Kinds of calls that may have a fault.
unsigned kinds_of(CallFault fault)
{
  switch (fault)
  {
    case CallFault::Error:
      return ~0U;
    case CallFault::Interrupted:
      return calls::open | calls::read | calls::create | calls::write | calls::close | calls::lock |
        calls::sync;
    case CallFault::Short:
      return calls::read | calls::write;
    default:
      return calls::read;
  }
}

bool is_in_folder(int file, const char* path)
{
  char name[4096] = {};
  if (path == nullptr && file >= 0)
  {
    char link[64];
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", file);
    const ssize_t size = ::readlink(link, name, sizeof name - 1);
    path = size > 0 ? name : nullptr;
  }
  return path != nullptr && std::strstr(path, failing.folder) != nullptr;
}

bool may_fail(unsigned kind, int file, const char* path)
{
  const bool of_file = (kind & (calls::memory | calls::map | calls::thread)) == 0;
  return failing.fault != CallFault::None &&
    (failing.kinds & kinds_of(failing.fault) & kind) != 0 &&
    (!of_file || failing.folder == nullptr || is_in_folder(file, path));
}

/// Sets errno as the fault says; false: the call is made.
bool fails(CallFault fault)
{
  errno = fault == CallFault::Interrupted ? EINTR
    : fault == CallFault::Error           ? failing.error
                                          : errno;
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

/// How many bytes of these are to be read or written.
std::size_t part_of(std::size_t bytes, CallFault fault)
{
  const std::size_t most = fault == CallFault::End ? 0 : fault == CallFault::Short ? 1 : bytes;
  return std::min(bytes, most);
}

/// Reads by call(bytes).
template <class Call>
ssize_t read_with(int file, void* buffer, std::size_t bytes, const Call& call)
{
  const CallFault fault = failing_calls::next_fault(calls::read, file);
  if (fault == CallFault::Shortened)
  {
    cut_in_two(file);
  }
  if (fails(fault))
  {
    return -1;
  }
  const ssize_t got = call(part_of(bytes, fault));
  change(static_cast<char*>(buffer), got > 0 ? static_cast<std::size_t>(got) : 0, fault);
  return got;
}

/// Writes by call(bytes).
template <class Call>
ssize_t write_with(int file, std::size_t bytes, const Call& call)
{
  const CallFault fault = failing_calls::next_fault(calls::write, file);
  return fails(fault) ? -1 : call(part_of(bytes, fault));
}

/// Opens by call(); paths of devices and folders never fail.
template <class Call>
int open_with(const char* path, int flags, const Call& call)
{
  const bool reads = (flags & O_ACCMODE) == O_RDONLY;
  const bool counts = (flags & O_DIRECTORY) == 0;
  const unsigned kind = reads ? calls::open : calls::create;
  return counts && fails(failing_calls::next_fault(kind, -1, path)) ? -1 : call();
}

/// Controls a file by one of the two names of fcntl: it fails where it copies a descriptor.
int control_with(const char* name, int file, int command, void* argument)
{
  const bool copies = command == F_DUPFD || command == F_DUPFD_CLOEXEC;
  const bool refused = copies && fails(failing_calls::next_fault(calls::copy, file));
  return refused ? -1 : of_system<int(int, int, ...)>(name)(file, command, argument);
}

/// Makes a call of the system by its name, unless it is to fail.
template <class... Arguments>
int make_call(const char* name, CallFault fault, Arguments... arguments)
{
  return fails(fault) ? -1 : of_system<int(Arguments...)>(name)(arguments...);
}
}

CallFault failing_calls::next_fault(unsigned kind, int file, const char* path) noexcept
{
  made += (kind & calls::reading) != 0 ? 1 : 0;
  if (!may_fail(kind, file, path))
  {
    return CallFault::None;
  }
  const long number = ++counted - failing.first;
  return number >= 0 && number < failing.count ? failing.fault : CallFault::None;
}

bool failing_calls::refuses(unsigned kind) noexcept
{
  return fails(next_fault(kind));
}

bool failing_calls::may_refuse(unsigned kind) noexcept
{
  return failing.fault != CallFault::None && (failing.kinds & kind) != 0;
}

const char* failing_calls::wanted_caller() noexcept
{
  return failing.caller;
}

void make_fail(const FailingCalls& calls)
{
  failing = calls;
  counted = 0;
  made = 0;
}

void stop_failing()
{
  failing.fault = CallFault::None;
}

long calls_that_may_fail()
{
  return counted;
}

long all_calls()
{
  return made;
}

long open_files()
{
  long count = 0;
  DIR* const folder = ::opendir("/proc/self/fd");
  while (folder != nullptr && ::readdir(folder) != nullptr)
  {
    ++count;
  }
  if (folder != nullptr)
  {
    ::closedir(folder);
  }
  return count;
}

// NOLINTBEGIN: the names and types are those of the system
#pragma GCC visibility push(default) // shared libraries are to find them
extern "C"
{
  /// For programs in other languages; empty texts are none.
  void granular_make_fail(unsigned kinds, int fault, int error, long first, long count,
    const char* folder, const char* caller)
  {
    static char texts[2][256]; // which threads may still look at
    make_fail({});
    std::snprintf(texts[0], sizeof texts[0], "%s", folder);
    std::snprintf(texts[1], sizeof texts[1], "%s", caller);
    make_fail({ static_cast<CallFault>(fault), first, count, kinds, error,
      *folder != '\0' ? texts[0] : nullptr, *caller != '\0' ? texts[1] : nullptr });
  }

  long granular_calls_that_may_fail()
  {
    return calls_that_may_fail();
  }

  ssize_t read(int file, void* buffer, size_t bytes)
  {
    static auto* const call = of_system<ssize_t(int, void*, size_t)>("read");
    return read_with(file, buffer, bytes, [&](size_t part) { return call(file, buffer, part); });
  }

  ssize_t pread(int file, void* buffer, size_t bytes, off_t offset)
  {
    static auto* const call = of_system<ssize_t(int, void*, size_t, off_t)>("pread");
    return read_with(
      file, buffer, bytes, [&](size_t part) { return call(file, buffer, part, offset); });
  }

  ssize_t write(int file, const void* buffer, size_t bytes)
  {
    static auto* const call = of_system<ssize_t(int, const void*, size_t)>("write");
    return write_with(file, bytes, [&](size_t part) { return call(file, buffer, part); });
  }

  ssize_t pwrite(int file, const void* buffer, size_t bytes, off_t offset)
  {
    static auto* const call = of_system<ssize_t(int, const void*, size_t, off_t)>("pwrite");
    return write_with(file, bytes, [&](size_t part) { return call(file, buffer, part, offset); });
  }

  ssize_t pwritev(int file, const struct iovec* parts, int count, off_t offset)
  {
    static auto* const call = of_system<ssize_t(int, const struct iovec*, int, off_t)>("pwritev");
    const CallFault fault = failing_calls::next_fault(calls::write, file);
    if (fault == CallFault::Short && count > 0)
    {
      const struct iovec one = { parts[0].iov_base, std::min<size_t>(parts[0].iov_len, 1) };
      return call(file, &one, 1, offset);
    }
    return fails(fault) ? -1 : call(file, parts, count, offset);
  }

  int open(const char* path, int flags, ...)
  {
    static auto* const call = of_system<int(const char*, int, ...)>("open");
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return open_with(path, flags, [&] { return call(path, flags, mode); });
  }

  ssize_t pread64(int file, void* buffer, size_t bytes, off_t offset)
  {
    return ::pread(file, buffer, bytes, offset);
  }

  ssize_t pwrite64(int file, const void* buffer, size_t bytes, off_t offset)
  {
    return ::pwrite(file, buffer, bytes, offset);
  }

  ssize_t pwritev64(int file, const struct iovec* parts, int count, off_t offset)
  {
    return ::pwritev(file, parts, count, offset);
  }

  int open64(const char* path, int flags, ...)
  {
    va_list more;
    va_start(more, flags);
    const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
    va_end(more);
    return ::open(path, flags, mode);
  }

  int mkdir(const char* path, mode_t mode) noexcept
  {
    return make_call("mkdir", failing_calls::next_fault(calls::create, -1, path), path, mode);
  }

  int close(int file)
  {
    const CallFault fault = failing_calls::next_fault(calls::close, file);
    const int done = of_system<int(int)>("close")(file); // also after an error, as Linux has it
    return fails(fault) ? -1 : done;
  }

  int fstat(int file, struct stat* status) noexcept
  {
    return make_call("fstat", failing_calls::next_fault(calls::stat, file), file, status);
  }

  int stat(const char* path, struct stat* status) noexcept
  {
    return make_call("stat", failing_calls::next_fault(calls::stat, -1, path), path, status);
  }

  int lstat(const char* path, struct stat* status) noexcept
  {
    return make_call("lstat", failing_calls::next_fault(calls::stat, -1, path), path, status);
  }

  int stat64(const char* path, struct stat64* status) noexcept
  {
    return make_call("stat64", failing_calls::next_fault(calls::stat, -1, path), path, status);
  }

  int lstat64(const char* path, struct stat64* status) noexcept
  {
    return make_call("lstat64", failing_calls::next_fault(calls::stat, -1, path), path, status);
  }

  int fstat64(int file, struct stat64* status) noexcept
  {
    return make_call("fstat64", failing_calls::next_fault(calls::stat, file), file, status);
  }

  int access(const char* path, int mode) noexcept
  {
    return make_call("access", failing_calls::next_fault(calls::stat, -1, path), path, mode);
  }

  int faccessat(int folder, const char* path, int mode, int flags) noexcept
  {
    return make_call(
      "faccessat", failing_calls::next_fault(calls::stat, -1, path), folder, path, mode, flags);
  }

  int rename(const char* from, const char* to) noexcept
  {
    return make_call("rename", failing_calls::next_fault(calls::rename, -1, to), from, to);
  }

  int link(const char* from, const char* to) noexcept
  {
    return make_call("link", failing_calls::next_fault(calls::rename, -1, to), from, to);
  }

  int unlink(const char* path) noexcept
  {
    return make_call("unlink", failing_calls::next_fault(calls::unlink, -1, path), path);
  }

  int fchmod(int file, mode_t mode) noexcept
  {
    return make_call("fchmod", failing_calls::next_fault(calls::change, file), file, mode);
  }

  int chmod(const char* path, mode_t mode) noexcept
  {
    return make_call("chmod", failing_calls::next_fault(calls::change, -1, path), path, mode);
  }

  int ftruncate(int file, off_t size) noexcept
  {
    return make_call("ftruncate", failing_calls::next_fault(calls::change, file), file, size);
  }

  int flock(int file, int operation) noexcept
  {
    return make_call("flock", failing_calls::next_fault(calls::lock, file), file, operation);
  }

  int fcntl(int file, int command, ...)
  {
    va_list more;
    va_start(more, command);
    void* const argument = va_arg(more, void*); // numbers are as wide
    va_end(more);
    return control_with("fcntl", file, command, argument);
  }

  int fcntl64(int file, int command, ...)
  {
    va_list more;
    va_start(more, command);
    void* const argument = va_arg(more, void*);
    va_end(more);
    return control_with("fcntl64", file, command, argument);
  }

  /// The disk is not waited for: nothing that is tested depends on it, and it takes most of the time.
  int fsync(int file)
  {
    return fails(failing_calls::next_fault(calls::sync, file)) ? -1 : 0;
  }

  int fdatasync(int file)
  {
    return ::fsync(file);
  }
}
#pragma GCC visibility pop
// NOLINTEND
