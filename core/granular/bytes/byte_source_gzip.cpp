// SPDX-License-Identifier: BSD-3-Clause
// gzip, RFC 1952. zlib reads headers, and a library inflates; trailers are read here, since none checks them in what is inflated
// from the middle on.
#include "granular/bytes/byte_source_unpack.h"

#include "granular/common/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#define ZLIB_CONST
#include <zlib.h>

namespace granular
{
namespace
{
constexpr std::size_t window_bytes = std::size_t{ 1 } << 15;

/// Returns a number as users know sums: 0x and hexadecimal digits.
std::string hexadecimal(std::uint32_t value)
{
  std::array<char, 8> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, 16).ptr;
  return "0x" + std::string(digits.data(), end);
}

struct EndInflate
{
  void operator()(z_stream* stream) const noexcept { inflateEnd(stream); }
};

/// Passes over the header of a member. Returns false if the file ends within it. Throws FormatError.
bool pass_header(PackedInput& in)
{
  constexpr int gzip_format = 15 + 16; // of any window
  constexpr int reserved = 0xe0;
  constexpr int at_block = 128;
  const Where where{ in.path(), 0, in.position() };
  const std::int64_t start = in.position();
  for (const int expected : { 0x1f, 0x8b, 0x08 })
  {
    const int byte = in.get();
    if (byte >= 0 && byte != expected)
    {
      throw FormatError(
        "expected the end of the gzip data or more of them, got other bytes", where);
    }
  }
  const int flags = std::max(in.get(), 0);
  if ((flags & reserved) != 0)
  {
    throw FormatError("expected a gzip header, got flags that are not defined (" +
        hexadecimal(static_cast<std::uint32_t>(flags)) + ")",
      where);
  }
  in.seek(start);
  z_stream stream = {};
  if (inflateInit2(&stream, gzip_format) != Z_OK)
  {
    throw std::bad_alloc();
  }
  const std::unique_ptr<z_stream, EndInflate> end(&stream);
  Bytef none = 0;
  stream.next_out = &none; // without room for any
  while ((stream.data_type & at_block) == 0 && in.more())
  {
    stream.next_in = in.data();
    stream.avail_in = static_cast<uInt>(in.size());
    if (inflate(&stream, Z_BLOCK) == Z_DATA_ERROR)
    {
      throw FormatError("expected a gzip header that fits its CRC, got another", where);
    }
    in.skip(in.size() - stream.avail_in);
  }
  return (stream.data_type & at_block) != 0;
}

class GzipDecoder final : public Decoder
{
public:
  GzipDecoder(
    const ByteSource& packed, std::shared_ptr<SeekPoints> points, const Inflation& inflation)
    : Decoder(packed, std::move(points))
    , inflate_(inflation.make())
  {
  }

  const char* name() const noexcept override { return "gzip"; }
  void restart(const SeekPoints::Point& point) override;
  std::size_t decode(char* out, std::size_t bytes) override;
  void expect(const SeekPoints::Point& point) override;

private:
  /// The part of a member that comes next.
  enum class Part
  {
    Header,
    Data,
    Trailer
  };

  bool read_header();
  std::size_t read_data(char* out, std::size_t bytes);
  std::size_t inflate_some(std::span<char> out, bool to_block);
  std::optional<std::uint32_t> read_32();
  bool read_trailer();
  std::int64_t to_search() const noexcept;
  void remember(std::string_view content);
  bool has_window() const noexcept;
  void count_search(std::ptrdiff_t packed, bool found);
  void note_point(int bits);

  std::unique_ptr<Inflate> inflate_;
  Part part_ = Part::Header;
  std::uint32_t check_ = 0;        ///< CRC-32 of the member so far
  std::uint32_t member_bytes_ = 0; ///< of the member so far, modulo 2^32
  std::string last_; ///< bytes of the member: at least a window of them where a point is due
  std::int64_t searched_ = 0;    ///< bytes of the file, for the beginning of a block
  std::int64_t pause_ = 0;       ///< bytes of content without a search
  std::int64_t search_from_ = 0; ///< in the content
};

void GzipDecoder::restart(const SeekPoints::Point& point)
{
  in_.seek(point.packed);
  offset_ = point.offset;
  searched_ = pause_ = search_from_ = 0;
  part_ = Part::Header;
  if (point.window.empty())
  {
    return;
  }
  const int bits = point.bits & 7;
  int byte = 0;
  if (bits > 0)
  {
    in_.seek(point.packed - 1);
    byte = std::max(in_.get(), 0); // should the file end here now, the next read sees it
  }
  inflate_->start(bits, static_cast<unsigned>(byte), point.window);
  last_ = point.window;
  check_ = point.check;
  member_bytes_ = point.member_bytes;
  part_ = Part::Data;
}

std::size_t GzipDecoder::decode(char* out, std::size_t bytes)
{
  for (;;)
  {
    if (part_ == Part::Header && !this->read_header())
    {
      return 0;
    }
    if (part_ == Part::Data)
    {
      const std::size_t got = this->read_data(out, bytes);
      if (part_ == Part::Trailer)
      {
        this->read_trailer(); // before what it speaks of is given away
      }
      if (got > 0 || part_ == Part::Data)
      {
        return got;
      }
    }
    if (part_ == Part::Trailer && !this->read_trailer())
    {
      return 0;
    }
  }
}

/// A member that was inflated may still have the end of its member to come.
void GzipDecoder::expect(const SeekPoints::Point& point)
{
  char none = 0;
  for (int tries = 0; tries < 2 && point.window.empty() && part_ == Part::Data; ++tries)
  {
    in_.more();
    this->inflate_some({ &none, 0 }, false);
  }
  if (part_ == Part::Trailer)
  {
    this->read_trailer();
  }
  const bool same = point.window.empty()
    ? part_ == Part::Header
    : part_ == Part::Data && check_ == point.check && member_bytes_ == point.member_bytes;
  if (!same)
  {
    this->fail("their sum is another");
  }
}

/// False if there is no other member, or not yet the whole of its header.
bool GzipDecoder::read_header()
{
  int padding = 0;
  while (padding == 0)
  {
    padding = in_.get();
  }
  if (padding < 0)
  {
    return this->end_of_file(false);
  }
  const std::int64_t start = in_.position() - 1;
  in_.seek(start);
  if (!pass_header(in_))
  {
    in_.seek(start); // there may be more of it next time
    return this->end_of_file(true);
  }
  if (this->to_next_point() == 0)
  {
    this->add_point({ offset_, start, 0, 0, 0, {} });
  }
  inflate_->start();
  last_.clear();
  check_ = 0;
  member_bytes_ = 0;
  part_ = Part::Data;
  return true;
}

/// The next bytes of the member. 0 at its end, or at that of the file.
std::size_t GzipDecoder::read_data(char* out, std::size_t bytes)
{
  std::size_t done = 0;
  while (part_ == Part::Data && done < bytes)
  {
    const bool more = in_.more();
    // Up to where a point is due at full speed, then to the end of the block of deflate: only there
    // can it start. A block may be long - nothing limits it, common writers end it after some 100
    // KiB of content - and the next point is then as far away.
    const std::int64_t left = this->to_search();
    const std::size_t room =
      left == 0 ? bytes - done : std::min(bytes - done, static_cast<std::size_t>(left));
    const std::size_t got = this->inflate_some({ out + done, room }, left == 0 && more);
    done += got;
    if (!more && got == 0 && part_ == Part::Data)
    {
      if (done == 0)
      {
        this->end_of_file(true);
      }
      break;
    }
  }
  return done;
}

/// Makes a point where that is due and a block begins.
std::size_t GzipDecoder::inflate_some(std::span<char> out, bool to_block)
{
  const Inflate::Step step =
    inflate_->inflate({ reinterpret_cast<const char*>(in_.data()), in_.size() }, out, to_block);
  in_.seek(in_.position() + step.read);
  if (step.damage != nullptr)
  {
    this->fail(step.damage);
  }
  const std::string_view content(out.data(), step.written);
  check_ = inflate_->check(check_, content);
  member_bytes_ += static_cast<std::uint32_t>(content.size());
  offset_ += static_cast<std::int64_t>(content.size());
  this->remember(content);
  const bool found = !step.ended && step.block_bits && this->has_window();
  if (to_block)
  {
    this->count_search(step.read, found);
  }
  if (step.ended)
  {
    part_ = Part::Trailer;
  }
  else if (found)
  {
    this->note_point(*step.block_bits);
  }
  return content.size();
}

/// Not an empty one, which would look like the start of a member.
bool GzipDecoder::has_window() const noexcept
{
  return !last_.empty() && (last_.size() >= window_bytes || last_.size() == member_bytes_);
}

/// Bytes of content until the beginning of a block is looked for; 0: now.
std::int64_t GzipDecoder::to_search() const noexcept
{
  return std::max(this->to_next_point(), search_from_ - offset_);
}

/// A search takes several times as long as other bytes. Blocks may be endless, or begin where that is not seen: it is given up soon,
/// and tried again after more and more content.
void GzipDecoder::count_search(std::ptrdiff_t packed, bool found)
{
  constexpr std::int64_t most_searched = std::int64_t{ 1 } << 17;
  constexpr std::int64_t longest_pause = std::int64_t{ 1 } << 30;
  searched_ = found ? 0 : searched_ + packed;
  pause_ = found ? 0 : pause_;
  if (searched_ > most_searched)
  {
    pause_ = std::clamp(std::max(2 * pause_, this->spacing()), std::int64_t{ 1 }, longest_pause);
    search_from_ = offset_ + pause_;
    searched_ = 0;
  }
}

/// Keeps the content that a point needs, from where one is near.
void GzipDecoder::remember(std::string_view content)
{
  if (this->to_search() > static_cast<std::int64_t>(2 * window_bytes))
  {
    last_.clear();
    return;
  }
  if (last_.size() + content.size() > 4 * window_bytes) // not each time
  {
    last_.erase(0, last_.size() - std::min(last_.size(), window_bytes));
  }
  last_ += content.substr(content.size() - std::min(content.size(), window_bytes));
}

/// A block begins so many bits before the next byte of the file.
void GzipDecoder::note_point(int bits)
{
  const std::size_t begin = last_.size() - std::min(last_.size(), window_bytes);
  this->add_point({ offset_, in_.position() - bits / 8, static_cast<std::uint8_t>(bits % 8), check_,
    member_bytes_, last_.substr(begin) });
}

/// Nothing if the file ends within it.
std::optional<std::uint32_t> GzipDecoder::read_32()
{
  std::uint32_t number = 0;
  for (unsigned shift = 0; shift < 32; shift += 8)
  {
    const int byte = in_.get();
    if (byte < 0)
    {
      return std::nullopt;
    }
    number |= static_cast<std::uint32_t>(byte) << shift;
  }
  return number;
}

/// False if the file ends within it. A CRC that is there counts, whether the size is there or not.
bool GzipDecoder::read_trailer()
{
  const std::int64_t start = in_.position();
  const Where where{ in_.path(), 0, start };
  const std::optional<std::uint32_t> check = this->read_32();
  if (check && *check != check_)
  {
    throw FormatError(
      "expected gzip data with the CRC-32 " + hexadecimal(*check) + ", got " + hexadecimal(check_),
      where);
  }
  const std::optional<std::uint32_t> bytes = check ? this->read_32() : std::nullopt;
  if (!bytes)
  {
    in_.seek(start); // there may be more of it next time
    return this->end_of_file(true);
  }
  if (*bytes != member_bytes_)
  {
    throw FormatError("expected gzip data of " + std::to_string(*bytes) +
        " bytes modulo 2^32, got " + std::to_string(member_bytes_),
      where);
  }
  part_ = Part::Header;
  return true;
}
}

std::unique_ptr<Decoder> make_gzip_decoder(
  const ByteSource& packed, std::shared_ptr<SeekPoints> points, const Inflation& inflation)
{
  return std::make_unique<GzipDecoder>(packed, std::move(points), inflation);
}
}
