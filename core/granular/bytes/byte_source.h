// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bytes_byte_source_h
#define granular_bytes_byte_source_h

#include "granular/common/progress.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The state of a file, to detect changes.
struct FileStamp
{
  std::int64_t size = 0;
  std::int64_t modified = 0; ///< nanoseconds since the epoch
  std::uint64_t inode = 0;
  std::uint64_t device = 0;

  bool operator==(const FileStamp&) const = default;
};

/// Bytes with random access. Files are read, not mapped: a mapped file that shrinks kills the process, while a read fails.
class ByteSource
{
public:
  virtual ~ByteSource() = default;

  /// Returns the name for messages.
  virtual const std::string& path() const = 0;

  /// Returns the current state of the file; for memory only the size; for a compressed source that of the packed file.
  virtual FileStamp stamp() const = 0;

  /// Reads bytes into a buffer, from an offset. Returns the number of bytes, which is smaller than requested only at the end.
  /// Throws IoError; for compressed files also FormatError (damaged, with the byte of the file) and LimitError.
  virtual std::size_t read(std::int64_t offset, char* buffer, std::size_t bytes) const = 0;

  /// Returns the fraction of the whole before a recently read offset, 0 to 1.
  virtual double fraction(std::int64_t offset) const;

  /// Returns true if going back is expensive and stamp().size is not the number of bytes.
  virtual bool compressed() const { return false; }

  /// Returns true if several threads may read at once, as from files and memory.
  virtual bool concurrent() const { return false; }

  /// Returns a warning about bytes without a checksum, such as truncated compressed data of a running simulation; empty:
  /// none. Known once the end was read.
  virtual std::string unchecked() const { return {}; }
};

/// Positions in a compressed file where decompression can start, found while it is read. Successive sources of the same file
/// share them.
struct SeekPoints
{
  struct Point
  {
    std::int64_t offset = 0;        ///< of the next byte of the content
    std::int64_t packed = 0;        ///< of the next whole byte in the file
    std::uint8_t bits = 0;          ///< gzip: bits of the previous byte that are still to come
    std::uint32_t check = 0;        ///< gzip: CRC-32 of the member up to here
    std::uint32_t member_bytes = 0; ///< gzip: of the member up to here, modulo 2^32
    std::string window; ///< gzip: the 32 KiB before; empty: a member or frame starts here

    bool operator==(const Point&) const = default;
  };

  static constexpr std::int64_t widest_spacing = std::int64_t{ 1 } << 24;

  std::vector<Point> points;                      ///< by offset
  std::int64_t spacing = std::int64_t{ 1 } << 20; ///< smallest distance of two, in bytes of content

  /// Returns the bytes of memory.
  std::size_t bytes() const noexcept;
};

/// The content of a compressed file may have so many times its bytes, at most. Real dumps reach 90.
inline constexpr std::int64_t largest_expansion = 200;

/// Content below this size [bytes], 256 MiB, is read whatever the size of its compressed file.
inline constexpr std::int64_t free_content = std::int64_t{ 1 } << 28;

/// Opens a plain file. Throws IoError if the file is missing, unreadable, a directory or not a regular file. Reading throws
/// IoError, too, if the file ends before its size at opening.
std::unique_ptr<ByteSource> open_file(const std::string& path);

/// Returns a source of the bytes of a string, which must outlive it.
std::unique_ptr<ByteSource> open_memory(std::string_view bytes, std::string name = "memory");

/// Returns the bytes of a source before `end`, as many as there are. Reports progress, unless it is null, and throws Cancelled.
std::string read_up_to(const ByteSource& source, std::int64_t end, Progress* progress = nullptr);

/// Returns a source of the first bytes of another one: a snapshot of a file while others append to it. The beginning is read
/// here, once, and kept. Throws the errors of reading.
std::unique_ptr<ByteSource> first_bytes(std::unique_ptr<ByteSource> source, std::int64_t bytes);

/// Returns the contents of a source: the decompressed bytes of gzip (RFC 1952, any number of members) and Zstandard (RFC
/// 8878, any number of frames), and the bytes of anything else. Truncated data end early; see ByteSource::unchecked. A
/// compressed source keeps the last MiB. To go back further, it restarts at a seek point: about every `spacing` bytes of
/// gzip, which grows to 16 MiB when there are many; at starts of frames of Zstandard. A compressed source serves one thread
/// at a time and reads up to 64 KiB ahead. Throws IoError; reading also throws FormatError and LimitError (a Zstandard window
/// above 128 MiB; content beyond free_content and largest_expansion times the file), and the same error again later, because
/// bytes before the damage may be wrong, too.
std::unique_ptr<ByteSource> unpack(
  std::unique_ptr<ByteSource> packed, std::shared_ptr<SeekPoints> points = nullptr);

/// Returns the contents of a source as unpack does, by seek points to which none is added: other readers may use them at the same
/// time. Without points it finds its own.
std::unique_ptr<ByteSource> unpack_known(
  std::unique_ptr<ByteSource> packed, std::shared_ptr<const SeekPoints> points);

/// Returns the content of a compressed file from an offset to another for several threads at once: each decompresses what it
/// needs from one seek point to the next, keeps that for the others, and decompresses the next part where it would have to wait. At
/// the end offset the content seems to end. Returns null where that would not help: with one thread, with fewer than three such
/// parts, or with one above 64 MiB. Memory: twice as many parts as threads, two more, those that threads copy from, and a decoder for
/// each thread. The sums of the file are compared for each part. Throws, and reading throws, as unpack does.
std::unique_ptr<ByteSource> unpack_segments(std::unique_ptr<ByteSource>& packed,
  const SeekPoints& points, std::int64_t begin, std::int64_t end, int threads);

/// A buffer that may be read up to `padding` bytes before its start and after its end, for the 64-byte steps of the row
/// decoder. The padding holds line feeds.
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
