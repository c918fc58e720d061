// SPDX-License-Identifier: BSD-3-Clause
// What the decompressors of byte_source_*.cpp share; for these files alone.
#ifndef granular_bytes_byte_source_unpack_h
#define granular_bytes_byte_source_unpack_h

#include "granular/bytes/byte_source.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace granular
{
/// The bytes of a compressed file, one after the other, through a buffer.
class PackedInput
{
public:
  explicit PackedInput(const ByteSource& source);

  const std::string& path() const { return source_.path(); }

  /// Of the next byte in the file.
  std::int64_t position() const noexcept { return start_ + static_cast<std::int64_t>(next_); }
  void seek(std::int64_t position) noexcept;

  /// Sees to it that there is a next byte; false at the end of the file, which may grow. IoError.
  bool more();

  /// The bytes that are in the buffer.
  const unsigned char* data() const noexcept { return buffer_.get() + next_; }
  std::size_t size() const noexcept { return filled_ - next_; }
  void skip(std::size_t bytes) noexcept { next_ += bytes; }

  /// The next byte; -1 at the end of the file.
  int get();

private:
  const ByteSource& source_;
  std::unique_ptr<unsigned char[]> buffer_;
  std::int64_t start_ = 0; ///< of the buffer in the file
  std::size_t filled_ = 0;
  std::size_t next_ = 0;
};

/// Decompresses forwards, and notes where it could start again.
class Decoder
{
public:
  Decoder(const ByteSource& packed, SeekPoints& points)
    : in_(packed)
    , points_(points)
  {
  }
  virtual ~Decoder() = default;

  /// Goes on at a point; SeekPoints::Point{} is the start of the file.
  virtual void restart(const SeekPoints::Point& point) = 0;

  /// Writes the next bytes of the content, as many as there are at once; 0 only at the end of what
  /// the file holds. Throws IoError, FormatError and LimitError; restart() is due after each.
  virtual std::size_t decode(char* out, std::size_t bytes) = 0;

  /// After decode gave 0: whether the file ends before its data do.
  bool cut() const noexcept { return cut_; }

  const std::string& path() const { return in_.path(); }

  /// As users spell the format.
  virtual const char* name() const noexcept = 0;

  /// Of the next byte in the file.
  std::int64_t position() const noexcept { return in_.position(); }

protected:
  /// Bytes of content up to where the next point is due; 0: it is.
  std::int64_t to_next_point() const noexcept;
  void add_point(SeekPoints::Point point);

  /// Says that the end of the file was met, within the data or behind them. Gives false.
  bool end_of_file(bool cut) noexcept
  {
    cut_ = cut;
    return false;
  }

  /// Throws the FormatError for data that are none of the format, found at the next byte.
  [[noreturn]] void fail(const std::string& why) const;

  PackedInput in_;
  std::int64_t offset_ = 0; ///< of the next byte of the content

private:
  SeekPoints& points_;
  bool cut_ = false;
};

std::unique_ptr<Decoder> make_gzip_decoder(const ByteSource& packed, SeekPoints& points);
std::unique_ptr<Decoder> make_zstd_decoder(const ByteSource& packed, SeekPoints& points);
}
#endif
