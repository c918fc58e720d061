// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/find_files.h"
#include "granular/bytes/system_calls.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <glob.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace granular
{
std::string with_slashes(const std::string& name)
{
  return name;
}

namespace os
{
namespace
{
namespace fs = std::filesystem;

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

Status status_of(const struct stat& status) noexcept
{
  constexpr std::int64_t nanoseconds = 1'000'000'000; // of a second
  constexpr mode_t permission_bits = 0777;
  const Kind kind = S_ISREG(status.st_mode) ? Kind::File
    : S_ISDIR(status.st_mode)               ? Kind::Folder
    : S_ISLNK(status.st_mode)               ? Kind::Link
                                            : Kind::Other;
  return { kind,
    { status.st_size, status.st_mtim.tv_sec * nanoseconds + status.st_mtim.tv_nsec, status.st_ino,
      status.st_dev },
    status.st_mode & permission_bits, status.st_uid, status.st_gid };
}
}

int open(const std::string& name, Opening how, unsigned permissions) noexcept
{
  static constexpr std::array flags{ O_RDONLY | O_NONBLOCK, O_WRONLY, O_RDONLY | O_NOFOLLOW,
    O_WRONLY | O_NOFOLLOW | O_NONBLOCK, O_WRONLY | O_CREAT | O_EXCL, O_RDONLY | O_DIRECTORY };
  return call_again(
    [&] {
      return ::open(name.c_str(), flags[static_cast<std::size_t>(how)] | O_CLOEXEC, permissions);
    });
}

int close(int file) noexcept
{
  return ::close(file);
}

std::ptrdiff_t read_at(int file, char* buffer, std::size_t bytes, std::int64_t offset) noexcept
{
  return call_again([&] { return ::pread(file, buffer, bytes, offset); });
}

std::ptrdiff_t write_at(
  int file, const char* bytes, std::size_t count, std::int64_t offset) noexcept
{
  return ::pwrite(file, bytes, count, offset);
}

int sync(int file) noexcept
{
  return call_again([&] { return ::fsync(file); });
}

int lock(int file) noexcept
{
  return call_again([&] { return ::flock(file, LOCK_EX | LOCK_NB); });
}

int settle(int) noexcept
{
  return 0;
}

int status_of(int file, Status& status) noexcept
{
  struct stat found = {};
  const int result = ::fstat(file, &found);
  status = status_of(found);
  return result;
}

int status_of(const std::string& name, Status& status, bool behind_links) noexcept
{
  struct stat found = {};
  const int result = behind_links ? ::stat(name.c_str(), &found) : ::lstat(name.c_str(), &found);
  status = status_of(found);
  return result;
}

int set_owner(int file, unsigned owner, unsigned group) noexcept
{
  return ::fchown(file, owner, group);
}

int set_permissions(int file, unsigned permissions) noexcept
{
  return ::fchmod(file, permissions);
}

int duplicate(int file) noexcept
{
  return ::fcntl(file, F_DUPFD_CLOEXEC, 0);
}

int duplicate_to(int from, int to) noexcept
{
  return ::dup3(from, to, O_CLOEXEC);
}

int let_replace(int, int) noexcept
{
  return 0;
}

int may_write(const std::string& name) noexcept
{
  return ::faccessat(AT_FDCWD, name.c_str(), W_OK, AT_EACCESS);
}

int remove(const std::string& name) noexcept
{
  return ::unlink(name.c_str());
}

int rename(const std::string& from, const std::string& to) noexcept
{
  return std::rename(from.c_str(), to.c_str());
}

void remove_all(const std::string& folder, const std::string& begin) noexcept
{
  try
  {
    std::error_code failed;
    fs::directory_iterator entry(folder, failed);
    for (; !failed && entry != end(entry); entry.increment(failed))
    {
      if (std::string_view(entry->path().filename().native()).starts_with(begin))
      {
        std::error_code ignored;
        fs::remove_all(entry->path(), ignored);
      }
    }
  }
  catch (const std::bad_alloc&)
  {
    // small files stay
  }
}

int list(const std::string& folder)
{
  std::error_code error;
  const fs::directory_iterator files(folder, error);
  errno = error.value();
  return error ? -1 : 0;
}

std::vector<std::string> glob(const std::string& pattern)
{
  glob_t found = {};
  const std::unique_ptr<glob_t, decltype(&::globfree)> free(&found, ::globfree);
  if (::glob(pattern.c_str(), GLOB_NOESCAPE | GLOB_NOSORT, nullptr, &found) != 0)
  {
    return {};
  }
  return { found.gl_pathv, found.gl_pathv + found.gl_pathc };
}

std::string absolute(const std::string& name)
{
  return fs::absolute(name).lexically_normal().string();
}

std::string follow(const std::string& path)
{
  constexpr int most_links = 40; // as Linux has it
  fs::path behind = path;        // the folders before it are left as they are
  for (int links = 0; links <= most_links; ++links)
  {
    std::error_code error; // what it is is asked again
    if (!fs::is_symlink(fs::symlink_status(behind, error)))
    {
      return behind.string();
    }
    behind = behind.parent_path() / fs::read_symlink(behind, error);
    if (error)
    {
      errno = error.value();
      return {};
    }
  }
  errno = ELOOP;
  return {};
}

unsigned user() noexcept
{
  return ::geteuid();
}

int process() noexcept
{
  return ::getpid();
}

std::string machine()
{
  std::array<char, 256> name = {};
  ::gethostname(name.data(), name.size() - 1);
  return { name.data(), name.size() };
}
}
}
