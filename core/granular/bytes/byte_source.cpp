// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_source.h"

#include "granular/bytes/system_calls.h"

#include <algorithm>
#include <cstring>
#include <system_error>
#include <utility>

namespace granular
{
namespace
{
[[noreturn]] void fail(const char* action, const std::string& path, int error)
{
  const std::string reason = std::generic_category().message(error);
  throw IoError(
    std::string("cannot ") + action + ": " + reason, { path }, static_cast<std::errc>(error));
}

/// ByteSource::read from bytes in memory.
std::size_t copy_bytes(
  std::string_view from, std::int64_t offset, char* buffer, std::size_t bytes) noexcept
{
  const std::size_t start = std::min(static_cast<std::size_t>(offset), from.size());
  const std::size_t count = std::min(bytes, from.size() - start);
  std::copy_n(from.data() + start, count, buffer);
  return count;
}

class FileSource final : public ByteSource
{
public:
  explicit FileSource(const std::string& path)
    : path_(path)
    , file_(os::open(path, os::Opening::Read))
  {
    if (file_ < 0)
    {
      fail("open", path, errno);
    }
  }

  FileSource(const FileSource&) = delete;
  FileSource& operator=(const FileSource&) = delete;
  ~FileSource() override { os::close(file_); }

  const std::string& path() const override { return path_; }
  bool concurrent() const override { return true; }

  FileStamp stamp() const override { return this->status().stamp; }

  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override
  {
    std::size_t done = 0;
    while (done < bytes)
    {
      const std::int64_t at = offset + static_cast<std::int64_t>(done);
      const std::ptrdiff_t got = os::read_at(file_, buffer + done, bytes - done, at);
      if (got < 0)
      {
        fail("read", path_, errno);
      }
      if (got == 0)
      {
        this->check_end(at);
        break;
      }
      done += static_cast<std::size_t>(got);
    }
    return done;
  }

  /// Takes what the file is now for the least that it has from then on. Throws IoError for what is no plain file.
  void expect_file()
  {
    const os::Status status = this->status();
    if (status.kind != os::Kind::File)
    {
      refuse_no_file(path_, status.kind == os::Kind::Folder);
    }
    size_ = status.stamp.size;
    char byte = 0;
    // it has not grown meanwhile, either
    if (size_ == 0 && os::read_at(file_, &byte, 1, 0) > 0 && this->stamp().size == 0)
    {
      throw IoError("expected a file of a known size, got one of the system's, as in /proc",
        { path_ }, std::errc::not_supported);
    }
  }

private:
  os::Status status() const
  {
    os::Status status;
    if (os::status_of(file_, status) != 0)
    {
      fail("stat", path_, errno);
    }
    return status;
  }

  /// A read has met the end of the file at an offset.
  void check_end(std::int64_t offset) const
  {
    if (offset < size_)
    {
      throw IoError("the file was shortened while it was read: expected at least " +
          std::to_string(size_) + " bytes, got " + std::to_string(offset),
        { path_ });
    }
  }

  std::string path_;
  int file_ = -1;
  std::int64_t size_ = 0; ///< when it was opened
};

class FirstBytes final : public ByteSource
{
public:
  FirstBytes(std::unique_ptr<ByteSource> source, std::int64_t bytes)
    : source_(std::move(source))
    , bytes_(bytes)
    , head_(new char[head_bytes]) // not value-initialised: many files are smaller
    , there_(source_->read(0, head_.get(), std::min(head_bytes, static_cast<std::size_t>(bytes))))
  {
  }

  const std::string& path() const override { return source_->path(); }
  FileStamp stamp() const override { return source_->stamp(); }
  bool concurrent() const override { return source_->concurrent(); }

  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override
  {
    const auto left = static_cast<std::size_t>(std::max(std::int64_t{ 0 }, bytes_ - offset));
    const std::size_t wanted = std::min(bytes, left);
    // small files, and the beginning of others, are looked at several times
    if (offset + static_cast<std::int64_t>(wanted) <= static_cast<std::int64_t>(head_bytes))
    {
      return copy_bytes({ head_.get(), there_ }, offset, buffer, wanted);
    }
    return source_->read(offset, buffer, wanted);
  }

private:
  static constexpr std::size_t head_bytes = std::size_t{ 1 } << 14;

  std::unique_ptr<ByteSource> source_;
  std::int64_t bytes_;
  std::unique_ptr<char[]> head_;
  std::size_t there_; ///< bytes in it
};

class MemorySource final : public ByteSource
{
public:
  MemorySource(std::string_view bytes, std::string name)
    : bytes_(bytes)
    , path_(std::move(name))
  {
  }

  const std::string& path() const override { return path_; }
  bool concurrent() const override { return true; }

  FileStamp stamp() const override { return { .size = static_cast<std::int64_t>(bytes_.size()) }; }

  std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const override
  {
    return copy_bytes(bytes_, offset, buffer, bytes);
  }

private:
  std::string_view bytes_;
  std::string path_;
};
}

double ByteSource::fraction(std::int64_t offset) const
{
  const auto size = static_cast<double>(this->stamp().size);
  return size > 0 ? std::clamp(static_cast<double>(offset) / size, 0.0, 1.0) : 1.0;
}

std::unique_ptr<ByteSource> open_file(const std::string& path)
{
  auto source = std::make_unique<FileSource>(path);
  source->expect_file();
  return source;
}

std::unique_ptr<ByteSource> open_memory(std::string_view bytes, std::string name)
{
  return std::make_unique<MemorySource>(bytes, std::move(name));
}

std::string read_up_to(const ByteSource& source, std::int64_t end, Progress* progress)
{
  constexpr std::size_t least = std::size_t{ 1 } << 14;
  constexpr std::size_t most = std::size_t{ 1 } << 20; // between two reports
  std::string bytes;
  for (std::size_t wanted = 1, got = 1; wanted > 0 && got == wanted;)
  {
    const std::size_t from = bytes.size();
    const auto left = std::max(end - static_cast<std::int64_t>(from), std::int64_t{ 0 });
    // what end claims may not be there
    wanted = static_cast<std::size_t>(
      std::min(left, static_cast<std::int64_t>(std::clamp(from, least, most))));
    if (progress)
    {
      progress->step(source.fraction(static_cast<std::int64_t>(from)));
    }
    bytes.resize(from + wanted);
    got = source.read(static_cast<std::int64_t>(from), bytes.data() + from, wanted);
    bytes.resize(from + got);
  }
  return bytes;
}

std::unique_ptr<ByteSource> first_bytes(std::unique_ptr<ByteSource> source, std::int64_t bytes)
{
  return std::make_unique<FirstBytes>(std::move(source), bytes);
}

void PaddedBuffer::resize(std::size_t bytes)
{
  // not value-initialised: the buffers are read into at once
  std::unique_ptr<char[]> memory(new char[bytes + 2 * padding]);
  std::memset(memory.get(), '\n', padding);
  if (memory_)
  {
    std::memcpy(memory.get() + padding, memory_.get() + padding, std::min(bytes, size_));
  }
  std::memset(memory.get() + padding + bytes, '\n', padding);
  memory_ = std::move(memory);
  size_ = bytes;
}
}
