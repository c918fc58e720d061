// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_sink.h"

#include "granular/bytes/system_calls.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
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

void check(int error, const std::string& path)
{
  if (error != 0)
  {
    fail(path, error);
  }
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

/// An open file that closes itself. -1: none.
class Descriptor
{
public:
  explicit Descriptor(int file) noexcept
    : file_(file)
  {
  }
  Descriptor(Descriptor&& other) noexcept
    : file_(std::exchange(other.file_, -1))
  {
  }
  Descriptor& operator=(Descriptor&& other) noexcept
  {
    std::swap(file_, other.file_);
    return *this;
  }
  ~Descriptor()
  {
    if (file_ >= 0)
    {
      ::close(file_);
    }
  }

  int get() const noexcept { return file_; }

  /// Closes the file. Returns an error: a full disk behind a network may show here first.
  int close() noexcept
  {
    return ::close(std::exchange(file_, -1)) != 0 && errno != EINTR ? errno : 0;
  }

private:
  int file_;
};

Descriptor open_existing(const std::string& name, int flags)
{
  return Descriptor(call_again([&] { return ::open(name.c_str(), flags | O_CLOEXEC); }));
}

/// 0, or the reason. Some file systems keep nothing, or cannot tell.
int sync(int file) noexcept
{
  const bool done = call_again([&] { return ::fsync(file); }) == 0;
  return done || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS ? 0 : errno;
}

template <class Work>
void with_existing(const std::string& name, const std::string& path, const Work& work)
{
  Descriptor file = open_existing(name, O_WRONLY);
  check(file.get() < 0 ? errno : 0, path);
  work(file.get());
  check(file.close(), path);
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

NewFile::NewFile(const std::string& path, Locking locking)
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
    owner_ = old.st_uid;
    group_ = old.st_gid;
  }
  else if (errno != ENOENT || path.empty())
  {
    fail(path_, errno);
  }
  this->create(locking);
  if (permissions_ >= 0 && ::geteuid() != 0) // root's file is root's until the end: see LockedFile
  {
    try
    {
      this->keep_owner(); // before the first byte
    }
    catch (const IoError&)
    {
      this->remove();
      throw;
    }
  }
}

void NewFile::create(Locking locking)
{
  // who may not read the old file may not read along either
  const unsigned mode = permissions_ < 0 ? 0666 : 0600;
  try
  {
    locked_.emplace(target_, mode);
  }
  catch (const std::system_error& error)
  {
    fail(path_, error.code().value());
  }
  name_ = locked_->name();
  file_ = locked_->descriptor();
  if (locking == Locking::Others)
  {
    name_ += LockedFile::data_ending;
    ::unlink(name_.c_str()); // nobody else may have it: the lock is this object's
    file_ = call_again(
      [&] { return ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode); });
    check(file_ < 0 ? errno : 0, path_);
  }
}

/// Some file systems give all files one owner, so only the new file tells whether its owner differs.
void NewFile::keep_owner() const
{
  struct stat now = {};
  check(::fstat(file_, &now) != 0 ? errno : 0, path_);
  if ((now.st_uid != owner_ || now.st_gid != group_) && ::fchown(file_, owner_, group_) != 0)
  {
    const int error = errno;
    throw IoError("cannot write: the new file would not keep the owner and group of the old one: " +
        std::generic_category().message(error),
      { path_ }, static_cast<std::errc>(error));
  }
}

NewFile::~NewFile()
{
  this->remove();
}

void NewFile::remove() noexcept
{
  if (locked_ && name_ != locked_->name() && locked_->is_own())
  {
    ::unlink(name_.c_str());
  }
  this->close();
}

void NewFile::expect_own() const
{
  if (!locked_->is_own())
  {
    throw IoError("cannot write: expected the process that began the file, got a child of it",
      { path_ }, std::errc::operation_not_permitted);
  }
}

/// The lock last: until then the data are this object's.
void NewFile::close() noexcept
{
  if (file_ >= 0 && file_ != locked_->descriptor())
  {
    ::close(file_);
  }
  file_ = -1;
  locked_.reset();
}

void NewFile::write_at(std::int64_t offset, std::string_view bytes)
{
  this->expect_own();
  pwrite_all(file_, offset, bytes, path_);
}

void NewFile::set_permissions() const
{
  if (permissions_ >= 0)
  {
    this->keep_owner();
    // a file system without permissions gives all files the same, and may refuse to set them
    const auto wanted = static_cast<mode_t>(permissions_);
    struct stat now = {};
    if (::fstat(file_, &now) != 0 ||
      ((now.st_mode & permission_bits) != wanted && ::fchmod(file_, wanted) != 0))
    {
      fail(path_, errno);
    }
  }
}

/// Closes the file as far as a full disk behind a network may show, but not the lock: it holds until the file has its name.
void NewFile::expect_written() const
{
  Descriptor second(::fcntl(file_, F_DUPFD_CLOEXEC, 0));
  check(second.get() < 0 ? errno : second.close(), path_);
}

void NewFile::complete(bool durable) const
{
  if (file_ != locked_->descriptor())
  {
    const Descriptor now =
      open_existing(name_, O_RDONLY | O_NOFOLLOW); // others may have made it anew
    check(now.get() < 0 || ::dup3(now.get(), file_, O_CLOEXEC) < 0 ? errno : 0, path_);
  }
  this->set_permissions();
  check(durable ? sync(file_) : 0, path_);
  this->expect_written();
}

void NewFile::hold(bool durable)
{
  this->expect_own();
  this->complete(durable);
  if (file_ != locked_->descriptor())
  {
    ::close(file_);
  }
  locked_->close();
  file_ = -1;
}

/// Another file may have the name if somebody has removed this one.
void NewFile::expect_name() const
{
  check(locked_->has_name() ? 0 : ENOENT, path_);
}

void NewFile::finish(bool durable)
{
  this->expect_own();
  if (file_ >= 0)
  {
    this->complete(durable);
  }
  Descriptor folder(-1);
  if (durable)
  {
    folder = open_existing(target_.substr(0, target_.rfind('/') + 1) + ".", O_RDONLY | O_DIRECTORY);
    // a folder that may not be read cannot be synchronised
    check(folder.get() < 0 && errno != EACCES ? errno : 0, path_);
  }
  this->expect_name();
  if (std::rename(name_.c_str(), target_.c_str()) != 0)
  {
    fail(path_, errno);
  }
  this->close();
  const int error = folder.get() < 0 ? 0 : sync(folder.get());
  if (error != 0)
  {
    throw IoError(
      "written, but a loss of power may take the new file back: cannot synchronise its folder: " +
        std::generic_category().message(error),
      { path_ }, static_cast<std::errc>(error));
  }
}

void write_into(
  const std::string& name, std::int64_t offset, std::string_view bytes, const std::string& path)
{
  with_existing(name, path, [&](int file) { pwrite_all(file, offset, bytes, path); });
}

void sync_file(const std::string& name, const std::string& path)
{
  with_existing(name, path, [&](int file) { check(sync(file), path); });
}
}
