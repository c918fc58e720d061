// SPDX-License-Identifier: BSD-3-Clause
// Shared by the decompressors in byte_source_*.cpp and inflate.cpp; private to these files.
#ifndef granular_bytes_byte_source_unpack_h
#define granular_bytes_byte_source_unpack_h

#include "granular/bytes/byte_source.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace granular
{
/// The first bytes of a frame of Zstandard.
inline constexpr std::string_view zstd_magic = "\x28\xb5\x2f\xfd";

/// Reads the bytes of a compressed file in order, through a buffer.
class PackedInput
{
public:
  explicit PackedInput(const ByteSource& source);

  const std::string& path() const { return source_.path(); }

  /// Returns the offset of the next byte in the file.
  std::int64_t position() const noexcept { return start_ + static_cast<std::int64_t>(next_); }
  void seek(std::int64_t position) noexcept;

  /// Fills the buffer if it is empty. Returns false at the end of the file, which may still grow. Throws IoError.
  bool more();

  /// Returns the bytes in the buffer.
  const unsigned char* data() const noexcept { return buffer_.get() + next_; }
  std::size_t size() const noexcept { return filled_ - next_; }
  void skip(std::size_t bytes) noexcept { next_ += bytes; }

  /// Returns the next byte, or -1 at the end of the file.
  int get();

private:
  const ByteSource& source_;
  std::unique_ptr<unsigned char[]> buffer_;
  std::int64_t start_ = 0; ///< of the buffer in the file
  std::size_t filled_ = 0;
  std::size_t next_ = 0;
};

/// Decompresses from start to end, and records points from which decompression can restart.
class Decoder
{
public:
  /// points: gets those that are found; null: none are looked for.
  Decoder(const ByteSource& packed, std::shared_ptr<SeekPoints> points)
    : in_(packed)
    , points_(std::move(points))
  {
  }
  virtual ~Decoder() = default;

  /// Continues at a point; SeekPoints::Point{} is the start of the file.
  virtual void restart(const SeekPoints::Point& point) = 0;

  /// Writes the next bytes of the content, as many as are available at once; returns 0 only at the end of the file.
  /// Throws IoError, FormatError and LimitError; after each of them restart() must be called.
  virtual std::size_t decode(char* out, std::size_t bytes) = 0;

  /// Throws FormatError unless what was decoded since the last restart ends where a point is, and its sums fit.
  virtual void expect(const SeekPoints::Point& point) = 0;

  /// Returns true if decode() returned 0 because the file is truncated.
  bool cut() const noexcept { return cut_; }

  const std::string& path() const { return in_.path(); }

  /// Returns the name of the format as users spell it.
  virtual const char* name() const noexcept = 0;

  /// Returns the offset of the next byte in the file.
  std::int64_t position() const noexcept { return in_.position(); }

protected:
  /// Returns the bytes of content up to the next restart point; 0 if the point is due.
  std::int64_t to_next_point() const noexcept;
  std::int64_t spacing() const noexcept;
  void add_point(SeekPoints::Point point);

  /// Records that the end of the file was reached, within the compressed data (cut) or after it. Returns false.
  bool end_of_file(bool cut) noexcept
  {
    cut_ = cut;
    return false;
  }

  /// Throws FormatError for invalid compressed data at the next byte.
  [[noreturn]] void fail(const std::string& why) const;

  PackedInput in_;
  std::int64_t offset_ = 0; ///< of the next byte of the content

private:
  std::shared_ptr<SeekPoints> points_;
  bool cut_ = false;
};

/// Inflates deflate data (RFC 1951).
class Inflate
{
public:
  /// The outcome of a call.
  struct Step
  {
    std::ptrdiff_t read =
      0; ///< bytes of input; below 0: so many bytes of earlier calls were not needed
    std::size_t written = 0;
    bool ended = false;            ///< the last block is done
    const char* damage = nullptr;  ///< why the input is no deflate data
    std::optional<int> block_bits; ///< a block begins so many bits before the end of what was read
  };

  virtual ~Inflate() = default;

  /// Goes to the first block.
  virtual void start() = 0;

  /// Goes to a block between others: `bits` (0 to 7) of its first bits are the upper ones of a byte that comes before the
  /// input, and `window` (1 to 2^15 bytes) is the content before it.
  virtual void start(int bits, unsigned byte, std::string_view window) = 0;

  /// Inflates from `input` as much as there is room for. With `to_block`, stops where a block begins, if that can be seen and all
  /// content before was written, and may stop before that. Throws std::bad_alloc.
  virtual Step inflate(std::string_view input, std::span<char> output, bool to_block) = 0;

  /// Returns the CRC-32 of bytes behind others that have the CRC-32 `before`.
  virtual std::uint32_t check(std::uint32_t before, std::string_view bytes) const noexcept = 0;
};

/// A library that inflates.
struct Inflation
{
  const char* name;
  std::unique_ptr<Inflate> (*make)();
};

/// Returns those that there are, the fastest first. Whole data give the same content with all of them. What is damaged may be refused or
/// not, as long as no sum is compared: ISA-L takes codes that are incomplete but not used. If data end within a block, up to three of
/// the last bytes may be held back, and damage in its header may be seen or not.
std::span<const Inflation> inflations() noexcept;

std::unique_ptr<Decoder> make_gzip_decoder(
  const ByteSource& packed, std::shared_ptr<SeekPoints> points, const Inflation& inflation);
std::unique_ptr<Decoder> make_zstd_decoder(
  const ByteSource& packed, std::shared_ptr<SeekPoints> points);

using MakeDecoder =
  std::function<std::unique_ptr<Decoder>(const ByteSource&, std::shared_ptr<SeekPoints>)>;

/// Returns what makes a decoder for a file, by its first bytes; nothing if it is not compressed.
MakeDecoder find_decoder(const ByteSource& packed);

/// Returns the content of a file by a decoder: see unpack.
std::unique_ptr<ByteSource> unpack_by(const MakeDecoder& make_decoder,
  std::unique_ptr<ByteSource> packed, std::shared_ptr<SeekPoints> points);

/// Throws LimitError if so many bytes of content came out of a file that it was made to fill memory and time.
void expect_honest(const Decoder& decoder, std::int64_t content, const ByteSource& packed);
}
#endif
