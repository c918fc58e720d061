// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_sink.h"

#include "granular/bytes/system_calls.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace granular
{
namespace
{
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
    const std::ptrdiff_t done =
      os::write_at(file, bytes.data(), std::min(bytes.size(), most_bytes), offset);
    if (done < 0 && errno != EINTR)
    {
      fail(path, errno);
    }
    bytes.remove_prefix(done > 0 ? static_cast<std::size_t>(done) : 0);
    offset += std::max(done, std::ptrdiff_t{ 0 });
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
      os::close(file_);
    }
  }

  int get() const noexcept { return file_; }

  /// Closes the file. Returns an error: a full disk behind a network may show here first.
  int close() noexcept
  {
    return os::close(std::exchange(file_, -1)) != 0 && errno != EINTR ? errno : 0;
  }

private:
  int file_;
};

/// 0, or the reason. Some file systems keep nothing, or cannot tell.
int sync(int file) noexcept
{
  const bool done = os::sync(file) == 0;
  return done || errno == EINVAL || errno == ENOTSUP || errno == ENOSYS ? 0 : errno;
}

template <class Work>
void with_existing(const std::string& name, const std::string& path, const Work& work)
{
  Descriptor file(os::open(name, os::Opening::Write));
  check(file.get() < 0 ? errno : 0, path);
  work(file.get());
  check(file.close(), path);
}
}

NewFile::NewFile(const std::string& path, Locking locking)
  : path_(path)
{
  if (path.empty())
  {
    fail(path_, ENOENT);
  }
  target_ = os::follow(path);
  if (target_.empty())
  {
    fail(path_, errno);
  }
  os::Status old;
  if (os::status_of(target_, old) == 0)
  {
    if (old.kind == os::Kind::Folder)
    {
      fail(path_, EISDIR);
    }
    if (old.kind != os::Kind::File)
    {
      throw IoError("cannot write: expected a file, got a device or a pipe", { path_ },
        std::errc::not_supported);
    }
    if (os::may_write(target_) != 0)
    {
      fail(path_, errno); // who may not write it may not replace it either
    }
    permissions_ = static_cast<int>(old.permissions);
    owner_ = old.owner;
    group_ = old.group;
  }
  else if (errno != ENOENT)
  {
    fail(path_, errno);
  }
  this->create(locking);
  if (permissions_ >= 0 && os::user() != 0) // root's file is root's until the end: see LockedFile
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
    os::remove(name_); // nobody else may have it: the lock is this object's
    file_ = os::open(name_, os::Opening::Create, mode);
    check(file_ < 0 ? errno : 0, path_);
    if (os::let_replace(file_, locked_->descriptor()) < 0)
    {
      const int error = errno;
      os::close(std::exchange(file_, -1));
      fail(path_, error);
    }
  }
}

/// Some file systems give all files one owner, so only the new file tells whether its owner differs.
void NewFile::keep_owner() const
{
  os::Status now;
  check(os::status_of(file_, now) != 0 ? errno : 0, path_);
  if ((now.owner != owner_ || now.group != group_) && os::set_owner(file_, owner_, group_) != 0)
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
    os::remove(name_);
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
    os::close(file_);
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
    const auto wanted = static_cast<unsigned>(permissions_);
    os::Status now;
    if (os::status_of(file_, now) != 0 ||
      (now.permissions != wanted && os::set_permissions(file_, wanted) != 0))
    {
      fail(path_, errno);
    }
  }
}

/// Closes the file as far as a full disk behind a network may show, but not the lock: it holds until the file has its name.
void NewFile::expect_written() const
{
  Descriptor second(os::duplicate(file_));
  check(second.get() < 0 ? errno : second.close(), path_);
}

void NewFile::complete(bool durable) const
{
  if (file_ != locked_->descriptor())
  {
    const Descriptor now(os::open(name_, os::Opening::ReadSame)); // others may have made it anew
    check(now.get() < 0 || os::duplicate_to(now.get(), file_) < 0 ? errno : 0, path_);
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
    os::close(file_);
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
    folder =
      Descriptor(os::open(target_.substr(0, target_.rfind('/') + 1) + ".", os::Opening::Folder));
    // a folder that may not be read cannot be synchronised
    check(folder.get() < 0 && errno != EACCES ? errno : 0, path_);
  }
  this->expect_name();
  if (os::rename(name_, target_) != 0)
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
