// SPDX-License-Identifier: BSD-3-Clause
// Zstandard, RFC 8878.
#include "granular/bytes/byte_source_unpack.h"

#include "granular/common/error.h"

#include <array>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <zstd.h>
#include <zstd_errors.h>

namespace granular
{
namespace
{
constexpr int largest_window = 27; // as a power of 2; also what programs take unless told otherwise
constexpr int least_window = 10;   // RFC 8878, 3.1.1.1.2
constexpr std::size_t longest_header = 18;
constexpr int single_segment =
  1 << 5; // of the header's descriptor: the window is the content, and no field

struct FreeStream
{
  void operator()(ZSTD_DStream* stream) const noexcept { ZSTD_freeDStream(stream); }
};

class ZstdDecoder final : public Decoder
{
public:
  ZstdDecoder(const ByteSource& packed, std::shared_ptr<SeekPoints> points)
    : Decoder(packed, std::move(points))
    , stream_(ZSTD_createDStream())
  {
    if (!stream_ ||
      ZSTD_isError(ZSTD_DCtx_setParameter(stream_.get(), ZSTD_d_windowLogMax, largest_window)))
    {
      throw std::bad_alloc();
    }
  }

  const char* name() const noexcept override { return "zstd"; }
  void restart(const SeekPoints::Point& point) override;
  std::size_t decode(char* out, std::size_t bytes) override;
  void expect(const SeekPoints::Point& point) override;

private:
  std::size_t decompress(char* out, std::size_t bytes);
  void begin_frame();
  void read_header();
  void count_content(std::size_t bytes, bool ended);
  [[noreturn]] void fail_with(std::size_t status) const;
  [[noreturn]] void refuse_window() const;

  std::unique_ptr<ZSTD_DStream, FreeStream> stream_;
  std::int64_t frame_start_ = 0; ///< in the file
  bool in_frame_ = false;
  bool flushed_ = false;                      ///< the stream holds no content back
  std::optional<std::uint64_t> content_left_; ///< of the frame, if its header says how much it has
};

void ZstdDecoder::restart(const SeekPoints::Point& point)
{
  in_.seek(point.packed);
  offset_ = point.offset;
  in_frame_ = false;
}

std::size_t ZstdDecoder::decode(char* out, std::size_t bytes)
{
  for (;;)
  {
    const bool more = in_.more();
    if (!more && (!in_frame_ || flushed_))
    {
      this->end_of_file(in_frame_);
      return 0;
    }
    if (!in_frame_)
    {
      this->begin_frame();
    }
    if (const std::size_t got = this->decompress(out, bytes); got > 0)
    {
      return got;
    }
  }
}

/// Decompresses what is in the buffer. Returns the bytes of content.
std::size_t ZstdDecoder::decompress(char* out, std::size_t bytes)
{
  ZSTD_inBuffer input{ in_.data(), in_.size(), 0 };
  ZSTD_outBuffer output{ out, bytes, 0 };
  const std::size_t status = ZSTD_decompressStream(stream_.get(), &output, &input);
  if (ZSTD_isError(status))
  {
    this->fail_with(status); // at the first byte that was handed in: input.pos means nothing then
  }
  in_.skip(input.pos);
  offset_ += static_cast<std::int64_t>(output.pos);
  flushed_ = output.pos < output.size;
  in_frame_ = status != 0;
  this->count_content(output.pos, !in_frame_);
  return output.pos;
}

/// A frame that was decompressed may still have its sum to come.
void ZstdDecoder::expect(const SeekPoints::Point&)
{
  char none = 0;
  for (int tries = 0; tries < 3 && in_frame_ && in_.more(); ++tries)
  {
    this->decompress(&none, 0);
  }
  if (in_frame_)
  {
    this->fail("a frame does not end where another begins");
  }
}

void ZstdDecoder::begin_frame()
{
  frame_start_ = in_.position();
  if (this->to_next_point() == 0)
  {
    this->add_point({ offset_, frame_start_, 0, 0, 0, {} });
  }
  this->read_header();
  ZSTD_DCtx_reset(stream_.get(), ZSTD_reset_session_only);
  in_frame_ = true;
  flushed_ = true;
}

/// The bytes that are taken must not depend on the way in which a file is read. If the library gets a frame at once, with room for the content, it
/// takes any window, and refuses a content of another size than the header says; else it is the other way round. The header: RFC
/// 8878, 3.1.1.
void ZstdDecoder::read_header()
{
  std::array<char, longest_header> header;
  std::size_t bytes = 0;
  for (int next = in_.get(); next >= 0; next = bytes < header.size() ? in_.get() : -1)
  {
    header[bytes++] = static_cast<char>(next);
  }
  in_.seek(frame_start_);
  in_.more(); // the header may have ended in the next buffer
  const std::string_view text(header.data(), bytes);
  const std::size_t descriptor = zstd_magic.size();
  if (text.starts_with(zstd_magic) && bytes > descriptor + 1 &&
    (text[descriptor] & single_segment) == 0 &&
    static_cast<unsigned char>(text[descriptor + 1]) > (largest_window - least_window) << 3)
  {
    this->refuse_window();
  }
  const unsigned long long size = ZSTD_getFrameContentSize(text.data(), text.size());
  content_left_ = size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR
    ? std::nullopt
    : std::optional<std::uint64_t>(size);
}

/// Counts bytes of the frame, before they are given away.
void ZstdDecoder::count_content(std::size_t bytes, bool ended)
{
  if (content_left_ && (bytes > *content_left_ || (ended && bytes < *content_left_)))
  {
    this->fail("the content has another size than its header says");
  }
  if (content_left_)
  {
    *content_left_ -= bytes;
  }
}

void ZstdDecoder::refuse_window() const
{
  throw LimitError(
    "expected a zstd window of at most 128 MiB, got a larger one", { in_.path(), 0, frame_start_ });
}

void ZstdDecoder::fail_with(std::size_t status) const
{
  if (ZSTD_getErrorCode(status) == ZSTD_error_memory_allocation)
  {
    throw std::bad_alloc();
  }
  if (ZSTD_getErrorCode(status) == ZSTD_error_frameParameter_windowTooLarge)
  {
    this->refuse_window();
  }
  std::string why = ZSTD_getErrorName(status);
  why[0] = static_cast<char>(why[0] >= 'A' && why[0] <= 'Z' ? why[0] - 'A' + 'a' : why[0]);
  this->fail(why);
}
}

std::unique_ptr<Decoder> make_zstd_decoder(
  const ByteSource& packed, std::shared_ptr<SeekPoints> points)
{
  return std::make_unique<ZstdDecoder>(packed, std::move(points));
}
}
