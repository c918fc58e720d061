// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/find_files.h"
#include "granular/bytes/names_windows.h"
#include "granular/bytes/system_calls.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <new>

#include <fcntl.h>
#include <io.h>
#include <process.h>
#include <windows.h>

namespace granular::os
{
namespace
{
int fail_unless(BOOL done) noexcept
{
  return done ? 0 : fail();
}

HANDLE handle_of(int file) noexcept
{
  return reinterpret_cast<HANDLE>(::_get_osfhandle(file));
}

/// The file may be renamed and removed while it is open.
HANDLE open_handle(const std::string& name, DWORD access, DWORD disposition, DWORD flags)
{
  return ::CreateFileW(system_name(name).c_str(), access,
    FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, nullptr, disposition,
    flags | FILE_FLAG_BACKUP_SEMANTICS, // folders as well
    nullptr);
}

std::int64_t join(DWORD high, DWORD low) noexcept
{
  return static_cast<std::int64_t>(std::uint64_t{ high } << 32 | low);
}

int status_of_handle(HANDLE handle, Status& status) noexcept
{
  constexpr std::int64_t epoch = 116'444'736'000'000'000; // 1970 in 100 ns since 1601
  constexpr unsigned readable = 0444;
  constexpr unsigned writable = 0666;
  status = {};
  if (::GetFileType(handle) != FILE_TYPE_DISK)
  {
    return 0;
  }
  BY_HANDLE_FILE_INFORMATION found;
  if (!::GetFileInformationByHandle(handle, &found))
  {
    return fail();
  }
  const auto has = [&](DWORD attribute) { return (found.dwFileAttributes & attribute) != 0; };
  status.kind = has(FILE_ATTRIBUTE_DIRECTORY) ? Kind::Folder : Kind::File;
  status.stamp = { join(found.nFileSizeHigh, found.nFileSizeLow),
    (join(found.ftLastWriteTime.dwHighDateTime, found.ftLastWriteTime.dwLowDateTime) - epoch) * 100,
    static_cast<std::uint64_t>(join(found.nFileIndexHigh, found.nFileIndexLow)),
    found.dwVolumeSerialNumber };
  status.permissions = has(FILE_ATTRIBUTE_READONLY) ? readable : writable;
  return 0;
}

OVERLAPPED at_offset(std::int64_t offset) noexcept
{
  OVERLAPPED place = {};
  place.Offset = static_cast<DWORD>(offset);
  place.OffsetHigh = static_cast<DWORD>(offset >> 32);
  return place;
}

constexpr std::size_t most_bytes = std::size_t{ 1 } << 30; // of a call

/// A duplicate is passed on to programs that are started, unless told otherwise.
int keep_from_children(int file) noexcept
{
  if (file >= 0)
  {
    ::SetHandleInformation(handle_of(file), HANDLE_FLAG_INHERIT, 0);
  }
  return file;
}

/// Replaces a file that somebody has opened. Windows 10 can.
bool replace_open(const std::string& from, const std::wstring& to) noexcept
try
{
  const HANDLE handle = open_handle(from, DELETE | SYNCHRONIZE, OPEN_EXISTING, 0);
  const std::size_t bytes = to.size() * sizeof(wchar_t);
  std::vector<std::byte> memory(sizeof(FILE_RENAME_INFO) + bytes);
  auto& wanted = *new (memory.data()) FILE_RENAME_INFO{};
  // MinGW's header has neither the number of this kind of information nor its flags
  constexpr auto rename_information_ex = static_cast<FILE_INFO_BY_HANDLE_CLASS>(22);
  constexpr DWORD flags = 1 | 2; // replace if it exists, as POSIX does
  std::memcpy(memory.data(), &flags, sizeof flags);
  wanted.FileNameLength = static_cast<DWORD>(bytes);
  std::memcpy(memory.data() + offsetof(FILE_RENAME_INFO, FileName), to.data(), bytes);
  const bool done = handle != INVALID_HANDLE_VALUE &&
    ::SetFileInformationByHandle(
      handle, rename_information_ex, memory.data(), static_cast<DWORD>(memory.size()));
  ::CloseHandle(handle);
  return done;
}
catch (const std::bad_alloc&)
{
  return false;
}
}

int open(const std::string& name, Opening how, unsigned) noexcept
{
  if (how == Opening::Folder)
  {
    errno = EACCES; // rename() writes it through
    return -1;
  }
  constexpr DWORD both = GENERIC_READ | GENERIC_WRITE; // who only reads cannot synchronise
  static constexpr std::array<DWORD, 5> accesses{ GENERIC_READ, GENERIC_WRITE, both, GENERIC_WRITE,
    both };
  const bool is_same = how == Opening::ReadSame || how == Opening::WriteSame;
  const HANDLE handle = open_handle(name, accesses[static_cast<std::size_t>(how)],
    how == Opening::Create ? CREATE_NEW : OPEN_EXISTING,
    is_same ? FILE_FLAG_OPEN_REPARSE_POINT : 0);
  if (handle == INVALID_HANDLE_VALUE)
  {
    return fail();
  }
  const int file =
    ::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle), _O_BINARY | _O_NOINHERIT);
  if (file < 0)
  {
    ::CloseHandle(handle);
    errno = EMFILE;
  }
  return file;
}

int close(int file) noexcept
{
  return ::_close(file);
}

std::ptrdiff_t read_at(int file, char* buffer, std::size_t bytes, std::int64_t offset) noexcept
{
  OVERLAPPED place = at_offset(offset);
  DWORD done = 0;
  const auto wanted = static_cast<DWORD>(std::min(bytes, most_bytes));
  if (!::ReadFile(handle_of(file), buffer, wanted, &done, &place) &&
    ::GetLastError() != ERROR_HANDLE_EOF)
  {
    return fail();
  }
  return done;
}

std::ptrdiff_t write_at(
  int file, const char* bytes, std::size_t count, std::int64_t offset) noexcept
{
  OVERLAPPED place = at_offset(offset);
  DWORD done = 0;
  const auto wanted = static_cast<DWORD>(std::min(count, most_bytes));
  return ::WriteFile(handle_of(file), bytes, wanted, &done, &place) ? done : fail();
}

int sync(int file) noexcept
{
  return fail_unless(::FlushFileBuffers(handle_of(file)));
}

int lock(int file) noexcept
{
  OVERLAPPED place = at_offset(std::int64_t{ 1 } << 62); // others could not write locked bytes
  if (::LockFileEx(
        handle_of(file), LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &place))
  {
    return 0;
  }
  const bool is_taken =
    ::GetLastError() == ERROR_LOCK_VIOLATION || ::GetLastError() == ERROR_IO_PENDING;
  fail();
  errno = is_taken ? EWOULDBLOCK : errno;
  return -1;
}

int settle(int file) noexcept
{
  FILETIME now;
  ::GetSystemTimeAsFileTime(&now);
  return fail_unless(::SetFileTime(handle_of(file), nullptr, nullptr, &now));
}

int status_of(int file, Status& status) noexcept
{
  return status_of_handle(handle_of(file), status);
}

int status_of(const std::string& name, Status& status, bool behind_links) noexcept
{
  status = {};
  const HANDLE handle = open_handle(
    name, FILE_READ_ATTRIBUTES, OPEN_EXISTING, behind_links ? 0 : FILE_FLAG_OPEN_REPARSE_POINT);
  if (handle == INVALID_HANDLE_VALUE)
  {
    return fail();
  }
  const int result = status_of_handle(handle, status);
  const int error = errno;
  ::CloseHandle(handle);
  errno = error;
  return result;
}

int set_owner(int, unsigned, unsigned) noexcept
{
  return 0; // all files have the same
}

int set_permissions(int, unsigned) noexcept
{
  return 0; // a file that may be written has them
}

int duplicate(int file) noexcept
{
  return keep_from_children(::_dup(file));
}

int duplicate_to(int from, int to) noexcept
{
  return ::_dup2(from, to) == 0 ? keep_from_children(to) : -1;
}

int let_replace(int file, int other) noexcept
{
  return duplicate_to(other, file);
}

int may_write(const std::string& name) noexcept
{
  const DWORD attributes = ::GetFileAttributesW(system_name(name).c_str());
  if (attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_READONLY) != 0)
  {
    errno = EACCES;
    return -1;
  }
  const HANDLE handle = open_handle(name, GENERIC_WRITE, OPEN_EXISTING, 0);
  return handle == INVALID_HANDLE_VALUE ? fail() : fail_unless(::CloseHandle(handle));
}

int remove(const std::string& name) noexcept
{
  return fail_unless(::DeleteFileW(system_name(name).c_str()));
}

/// Tries again for a while: a program that looks for viruses opens each new file.
int rename(const std::string& from, const std::string& to) noexcept
{
  constexpr int most = 20;
  constexpr DWORD pause = 5; // ms
  const std::wstring target = system_name(to);
  for (int tries = 0;; ++tries)
  {
    if (::MoveFileExW(system_name(from).c_str(), target.c_str(),
          MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH))
    {
      return 0;
    }
    const int result = fail();
    const int error = errno;
    if (error == EACCES && replace_open(from, target))
    {
      return 0;
    }
    if (error != EACCES || tries == most)
    {
      errno = error;
      return result;
    }
    ::Sleep(pause);
  }
}

std::string follow(const std::string& path)
{
  const DWORD attributes = ::GetFileAttributesW(system_name(path).c_str());
  if (attributes == INVALID_FILE_ATTRIBUTES || (attributes & FILE_ATTRIBUTE_REPARSE_POINT) == 0)
  {
    return with_slashes(path);
  }
  std::array<wchar_t, 32768> name; // the longest one
  const HANDLE handle = open_handle(path, FILE_READ_ATTRIBUTES, OPEN_EXISTING, 0);
  const DWORD size = handle == INVALID_HANDLE_VALUE
    ? 0
    : ::GetFinalPathNameByHandleW(handle, name.data(), static_cast<DWORD>(name.size()), 0);
  if (size == 0)
  {
    fail();
  }
  ::CloseHandle(handle);
  return narrow({ name.data(), size });
}

unsigned user() noexcept
{
  return 0;
}

int process() noexcept
{
  return ::_getpid();
}

std::string machine()
{
  std::array<wchar_t, MAX_COMPUTERNAME_LENGTH + 1> name;
  auto size = static_cast<DWORD>(name.size());
  return ::GetComputerNameW(name.data(), &size) ? narrow({ name.data(), size }) : std::string();
}
}
