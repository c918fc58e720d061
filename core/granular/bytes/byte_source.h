// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bytes_byte_source_h
#define granular_bytes_byte_source_h

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

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
/// process, a read fails.
class ByteSource
{
public:
  virtual ~ByteSource() = default;

  /// Name for messages.
  virtual const std::string& path() const = 0;

  /// The state of the file now; for memory the size alone. Of a compressed file, the file itself.
  virtual FileStamp stamp() const = 0;

  /// Reads bytes into buffer, starting at offset. Returns how many were there: fewer than asked
  /// for only at the end. Throws IoError; of compressed files also FormatError (damaged, with the
  /// byte of the file) and LimitError.
  virtual std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const = 0;

  /// Which part of the whole lies before an offset that was read lately, 0 to 1.
  virtual double fraction(std::int64_t offset) const;

  /// Whether going far back costs, and stamp().size is not the number of bytes.
  virtual bool compressed() const { return false; }

  /// Whether several threads may read at once: so from files and memory.
  virtual bool concurrent() const { return false; }

  /// What to say of bytes that could not be checked: compressed data that end before their end, as
  /// those of a running simulation do. Known once the end was read; empty: nothing.
  virtual std::string unchecked() const { return {}; }
};

/// Places of a compressed file where decompression can start, found while it is read. Sources of
/// the same file share them, one after the other.
struct SeekPoints
{
  struct Point
  {
    std::int64_t offset = 0;        ///< of the next byte of the content
    std::int64_t packed = 0;        ///< of the next whole byte in the file
    std::uint8_t bits = 0;          ///< gzip: how many bits of the byte before are still to come
    std::uint32_t check = 0;        ///< gzip: CRC-32 of the member up to here
    std::uint32_t member_bytes = 0; ///< gzip: of the member up to here, modulo 2^32
    std::string window; ///< gzip: the 32 KiB before; empty: a member or frame starts here

    bool operator==(const Point&) const = default;
  };

  std::vector<Point> points;                      ///< by offset
  std::int64_t spacing = std::int64_t{ 1 } << 20; ///< least distance of two, in bytes of content
  bool claimed =
    false; ///< not found in the file but said of it: a window is compared before what is behind it is given

  /// Bytes of memory.
  std::size_t bytes() const noexcept;
};

/// Opens a plain file. Throws IoError: missing, no permission, a directory, not a regular file. Reading throws IoError, too,
/// where the file ends before the size that it had when it was opened.
std::unique_ptr<ByteSource> open_file(const std::string& path);

/// The bytes of a string, which must outlive the source.
std::unique_ptr<ByteSource> open_memory(std::string_view bytes, std::string name = "memory");

/// The bytes of a source before end, as many as there are.
std::string read_up_to(const ByteSource& source, std::int64_t end);

/// The first bytes of a source: what a file held at one moment, while others append to it. The
/// beginning is read here, once, and kept. Throws what reading throws.
std::unique_ptr<ByteSource> first_bytes(std::unique_ptr<ByteSource> source, std::int64_t bytes);

/// What is inside, by content: the decompressed bytes of gzip (RFC 1952, any number of members) and
/// Zstandard (RFC 8878, any number of frames); all else as it is. Data that end before their
/// end are as long as they are; see ByteSource::unchecked.
/// A compressed source keeps the last MiB that was read; before that it goes back to a restart
/// point: about every `spacing` bytes of gzip, which grows to 16 MiB when there are many; of
/// Zstandard starts of frames. It is for one thread at a time, and reads up to 64 KiB ahead.
/// Throws IoError; reading also FormatError and LimitError (a Zstandard window above 128 MiB), and
/// the same again from then on: what lies before the place of damage may be wrong, too.
std::unique_ptr<ByteSource> unpack(
  std::unique_ptr<ByteSource> packed, std::shared_ptr<SeekPoints> points = nullptr);

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
