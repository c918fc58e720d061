// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_sink.h"

#include "granular/common/error.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace granular
{
namespace
{
constexpr mode_t permission_bits = 0777;

[[noreturn]] void fail(const std::string& path, int error)
{
  throw IoError("cannot write: " + std::generic_category().message(error), { path },
    static_cast<std::errc>(error));
}

void pwrite_all(int file, std::int64_t offset, std::string_view bytes, const std::string& path)
{
  constexpr std::size_t most_bytes = std::size_t{ 1 } << 30; // systems refuse 2 GiB at once
  while (!bytes.empty())
  {
    const ssize_t done =
      ::pwrite(file, bytes.data(), std::min(bytes.size(), most_bytes), static_cast<off_t>(offset));
    if (done < 0 && errno != EINTR)
    {
      fail(path, errno);
    }
    bytes.remove_prefix(done > 0 ? static_cast<std::size_t>(done) : 0);
    offset += std::max(done, ssize_t{ 0 });
  }
}

/// The path behind all symbolic links, there or not, where the folders before it are left as they are.
std::string follow(const std::string& path, std::error_code& error)
{
  namespace fs = std::filesystem;
  constexpr int most_links = 40; // as Linux has it
  fs::path behind = path;
  for (int links = 0; links <= most_links; ++links)
  {
    std::error_code ignored; // what it is is asked again
    if (!fs::is_symlink(fs::symlink_status(behind, ignored)))
    {
      return behind.string();
    }
    behind = behind.parent_path() / fs::read_symlink(behind, error);
    if (error)
    {
      return {};
    }
  }
  error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
  return {};
}
}

NewFile::NewFile(const std::string& path)
  : path_(path)
{
  std::error_code error;
  target_ = follow(path, error);
  if (error)
  {
    fail(path_, error.value());
  }
  struct stat old = {};
  if (::lstat(target_.c_str(), &old) == 0)
  {
    if (S_ISDIR(old.st_mode))
    {
      fail(path_, EISDIR);
    }
    if (!S_ISREG(old.st_mode))
    {
      throw IoError("cannot write: expected a file, got a device or a pipe", { path_ },
        std::errc::not_supported);
    }
    if (::faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0)
    {
      fail(path_, errno); // who may not write it may not replace it either
    }
    permissions_ = static_cast<int>(old.st_mode & permission_bits);
  }
  else if (errno != ENOENT || path.empty())
  {
    fail(path_, errno);
  }
  this->create();
}

void NewFile::create()
{
  // what crashed programs left behind, and what other threads are writing, is passed over
  constexpr int most_tries = 1000;
  const std::string begin =
    target_.substr(0, target_.rfind('/') + 1) + ".granular-" + std::to_string(::getpid()) + "-";
  // who may not read the old file may not read along either
  const mode_t mode = permissions_ < 0 ? 0666 : 0600;
  for (int number = 0; file_ < 0; ++number)
  {
    std::string name = begin + std::to_string(number) + ".tmp";
    file_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (file_ >= 0)
    {
      name_ = std::move(name);
    }
    else if ((errno != EEXIST && errno != EINTR) || number == most_tries)
    {
      fail(path_, errno);
    }
  }
}

NewFile::~NewFile()
{
  if (file_ >= 0)
  {
    ::close(file_);
  }
  if (!name_.empty())
  {
    ::unlink(name_.c_str());
  }
}

void NewFile::write_at(std::int64_t offset, std::string_view bytes)
{
  pwrite_all(file_, offset, bytes, path_);
}

void NewFile::finish()
{
  if (permissions_ >= 0)
  {
    // a file system without permissions gives all files the same, and may refuse to set them
    const auto wanted = static_cast<mode_t>(permissions_);
    struct stat now = {};
    if (::fstat(file_, &now) != 0 ||
      ((now.st_mode & permission_bits) != wanted && ::fchmod(file_, wanted) != 0))
    {
      fail(path_, errno);
    }
  }
  const int file = file_;
  file_ = -1;
  // a full disk behind a network may show here first
  if ((::close(file) != 0 && errno != EINTR) || std::rename(name_.c_str(), target_.c_str()) != 0)
  {
    fail(path_, errno);
  }
  name_.clear();
}

void write_into(
  const std::string& name, std::int64_t offset, std::string_view bytes, const std::string& path)
{
  int file = -1;
  do
  {
    file = ::open(name.c_str(), O_WRONLY | O_CLOEXEC);
  } while (file < 0 && errno == EINTR);
  if (file < 0)
  {
    fail(path, errno);
  }
  try
  {
    pwrite_all(file, offset, bytes, path);
  }
  catch (...)
  {
    ::close(file);
    throw;
  }
  if (::close(file) != 0 && errno != EINTR)
  {
    fail(path, errno);
  }
}

void write_file(const std::string& path, std::string_view bytes)
{
  NewFile file(path);
  file.write_at(0, bytes);
  file.finish();
}
}
