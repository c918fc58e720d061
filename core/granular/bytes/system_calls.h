// SPDX-License-Identifier: BSD-3-Clause
// Private to the files of this room.
#ifndef granular_bytes_system_calls_h
#define granular_bytes_system_calls_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"

#include <cerrno>
#include <string>

#include <sys/stat.h>

namespace granular
{
/// Makes a call of the system again when a signal has interrupted it, but not for ever. Returns what the call returns.
template <class Call>
auto call_again(const Call& call)
{
  constexpr int most = 100;
  auto result = call();
  for (int i = 1; i < most && result < 0 && errno == EINTR; ++i)
  {
    result = call();
  }
  return result;
}

inline FileStamp stamp_of_status(const struct stat& status) noexcept
{
  constexpr std::int64_t nanoseconds = 1'000'000'000; // of a second
  return { status.st_size, status.st_mtim.tv_sec * nanoseconds + status.st_mtim.tv_nsec,
    status.st_ino, status.st_dev };
}

/// Throws IoError for a directory, or for something else that is not a regular file.
[[noreturn]] inline void refuse_no_file(const std::string& path, bool is_folder)
{
  throw IoError(std::string("expected a file, got ") +
      (is_folder ? "a directory: name the files in it" : "a device or a pipe"),
    { path }, is_folder ? std::errc::is_a_directory : std::errc::not_supported);
}
}
#endif
