// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_base_byte_source_h
#define granular_base_byte_source_h

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace granular
{
/// What tells one state of a file from another.
struct FileStamp
{
  std::int64_t size = 0;
  std::int64_t modified = 0; ///< nanoseconds since the epoch
  std::uint64_t inode = 0;
  std::uint64_t device = 0;

  bool operator==(const FileStamp&) const = default;
};

/// Bytes with random access. Files are read, not mapped: a mapped file that shrinks kills the
/// process, a read comes back short.
class ByteSource
{
public:
  virtual ~ByteSource() = default;

  /// Name for messages.
  virtual const std::string& path() const = 0;

  /// The state of the file now; for memory the size alone.
  virtual FileStamp stamp() const = 0;

  /// Reads bytes into buffer, starting at offset. Returns how many were there: fewer than asked
  /// for only at the end. Throws IoError.
  virtual std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const = 0;
};

/// Opens a plain file. Throws IoError: missing, no permission, a directory, not a regular file.
std::unique_ptr<ByteSource> open_file(const std::string& path);

/// The bytes of a string, which must outlive the source.
std::unique_ptr<ByteSource> open_memory(std::string_view bytes, std::string name = "memory");

/// A buffer that may be read up to `padding` bytes before its start and after its end: what
/// the 64-byte steps of the row decoder need. The padding holds line feeds.
class PaddedBuffer
{
public:
  static constexpr std::size_t padding = 64;

  explicit PaddedBuffer(std::size_t bytes = 0) { this->resize(bytes); }

  char* data() noexcept { return memory_.get() + padding; }
  const char* data() const noexcept { return memory_.get() + padding; }
  std::size_t size() const noexcept { return size_; }

  /// Keeps the first min(size, bytes) bytes.
  void resize(std::size_t bytes);

private:
  std::unique_ptr<char[]> memory_;
  std::size_t size_ = 0;
};
}
#endif
