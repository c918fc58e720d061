// SPDX-License-Identifier: BSD-3-Clause
// gzip, RFC 1952. zlib inflates; header and trailer are read here, since zlib checks neither in what
// is inflated from the middle on.
#include "granular/bytes/byte_source_unpack.h"

#include "granular/common/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <new>
#include <optional>
#include <string>
#include <utility>

#define ZLIB_CONST
#include <zlib.h>

namespace granular
{
namespace
{
constexpr int raw_deflate = -15; // and windows of 2^15 bytes
constexpr std::size_t window_bytes = std::size_t{ 1 } << 15;

/// zlib's state.
class Inflate
{
public:
  Inflate()
  {
    if (inflateInit2(&stream_, raw_deflate) != Z_OK)
    {
      throw std::bad_alloc();
    }
  }
  Inflate(const Inflate&) = delete;
  Inflate& operator=(const Inflate&) = delete;
  ~Inflate() { inflateEnd(&stream_); }

  z_stream* operator->() noexcept { return &stream_; }
  z_stream* get() noexcept { return &stream_; }

private:
  z_stream stream_ = {};
};

/// The fields of a member's header, with the CRC of what was read of it.
class HeaderBytes
{
public:
  explicit HeaderBytes(PackedInput& in)
    : in_(in)
  {
  }

  /// 0 once the file has ended.
  unsigned get()
  {
    const int next = in_.get();
    ended_ = ended_ || next < 0;
    const auto byte = static_cast<Bytef>(ended_ ? 0 : next);
    check_ = crc32(check_, &byte, 1);
    return byte;
  }

  unsigned get_16()
  {
    const unsigned low = this->get();
    return low | this->get() << 8;
  }

  void skip(unsigned bytes)
  {
    for (; bytes > 0 && !ended_; --bytes)
    {
      this->get();
    }
  }

  void skip_text()
  {
    while (this->get() != 0)
    {
    }
  }

  bool ended() const noexcept { return ended_; }
  unsigned check_16() const noexcept { return check_ & 0xffffu; }

private:
  PackedInput& in_;
  uLong check_ = 0;
  bool ended_ = false;
};

std::string hexadecimal(std::uint32_t value)
{
  std::array<char, 8> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, 16).ptr;
  return "0x" + std::string(digits.data(), end);
}

class GzipDecoder final : public Decoder
{
public:
  using Decoder::Decoder;

  const char* name() const noexcept override { return "gzip"; }
  void restart(const SeekPoints::Point& point) override;
  std::size_t decode(char* out, std::size_t bytes) override;

private:
  /// Of a member: which comes next.
  enum class Part
  {
    Header,
    Data,
    Trailer
  };

  bool read_header();
  void parse_header(HeaderBytes& header) const;
  std::size_t read_data(char* out, std::size_t bytes);
  std::size_t inflate_some(char* out, std::size_t bytes, int flush);
  std::optional<std::uint32_t> read_32();
  bool read_trailer();
  void note_point();

  Inflate inflate_;
  Part part_ = Part::Header;
  std::uint32_t check_ = 0;        ///< CRC-32 of the member so far
  std::uint32_t member_bytes_ = 0; ///< of the member so far, modulo 2^32
};

void GzipDecoder::restart(const SeekPoints::Point& point)
{
  in_.seek(point.packed);
  offset_ = point.offset;
  part_ = Part::Header;
  if (point.window.empty())
  {
    return;
  }
  inflateReset(inflate_.get());
  const int bits = point.bits & 7;
  if (bits > 0)
  {
    in_.seek(point.packed - 1);
    const int byte = std::max(in_.get(), 0); // should the file end here now, the next read sees it
    inflatePrime(inflate_.get(), bits, byte >> (8 - bits));
  }
  inflateSetDictionary(inflate_.get(), reinterpret_cast<const Bytef*>(point.window.data()),
    static_cast<uInt>(point.window.size()));
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
  HeaderBytes header(in_);
  this->parse_header(header);
  if (header.ended())
  {
    in_.seek(start); // there may be more of it next time
    return this->end_of_file(true);
  }
  if (this->to_next_point() == 0)
  {
    this->add_point({ offset_, start, 0, 0, 0, {} });
  }
  inflateReset(inflate_.get());
  check_ = 0;
  member_bytes_ = 0;
  part_ = Part::Data;
  return true;
}

void GzipDecoder::parse_header(HeaderBytes& header) const
{
  enum : unsigned
  {
    has_check = 2,
    has_extra = 4,
    has_name = 8,
    has_comment = 16,
    reserved = 0xe0
  };
  const Where where{ in_.path(), 0, in_.position() };
  for (const unsigned expected : { 0x1fu, 0x8bu, 0x08u })
  {
    if (header.get() != expected && !header.ended())
    {
      throw FormatError(
        "expected the end of the gzip data or more of them, got other bytes", where);
    }
  }
  const unsigned flags = header.get();
  if ((flags & reserved) != 0)
  {
    throw FormatError(
      "expected a gzip header, got flags that are not defined (" + hexadecimal(flags) + ")", where);
  }
  header.skip(6); // time, how hard it was compressed, operating system
  if ((flags & has_extra) != 0)
  {
    header.skip(header.get_16());
  }
  if ((flags & has_name) != 0)
  {
    header.skip_text();
  }
  if ((flags & has_comment) != 0)
  {
    header.skip_text();
  }
  const unsigned check = header.check_16();
  if ((flags & has_check) != 0 && header.get_16() != check && !header.ended())
  {
    throw FormatError("expected a gzip header that fits its CRC, got another", where);
  }
}

/// The next bytes of the member. 0 at its end, or at that of the file.
std::size_t GzipDecoder::read_data(char* out, std::size_t bytes)
{
  while (part_ == Part::Data)
  {
    const bool more = in_.more();
    // Up to where a point is due at full speed, then to the end of the block of deflate: only there
    // can it start. A block may be long - nothing limits it, common writers end it after some 100
    // KiB of content - and the next point is then as far away.
    const std::int64_t left = this->to_next_point();
    const bool point_due = left == 0 && more;
    const std::size_t got =
      this->inflate_some(out, left == 0 ? bytes : std::min(bytes, static_cast<std::size_t>(left)),
        point_due ? Z_BLOCK : Z_NO_FLUSH);
    if (point_due && part_ == Part::Data)
    {
      this->note_point();
    }
    if (got > 0)
    {
      return got;
    }
    if (!more && part_ == Part::Data)
    {
      this->end_of_file(true);
      return 0;
    }
  }
  return 0;
}

std::size_t GzipDecoder::inflate_some(char* out, std::size_t bytes, int flush)
{
  inflate_->next_in = in_.data();
  inflate_->avail_in = static_cast<uInt>(in_.size());
  inflate_->next_out = reinterpret_cast<Bytef*>(out);
  inflate_->avail_out = static_cast<uInt>(bytes);
  const int status = inflate(inflate_.get(), flush);
  in_.skip(in_.size() - inflate_->avail_in);
  if (status == Z_MEM_ERROR)
  {
    throw std::bad_alloc();
  }
  if (status != Z_OK && status != Z_BUF_ERROR && status != Z_STREAM_END)
  {
    this->fail(inflate_->msg != nullptr ? inflate_->msg : "not known to zlib");
  }
  const std::size_t got = bytes - inflate_->avail_out;
  check_ = static_cast<std::uint32_t>(crc32_z(check_, reinterpret_cast<const Bytef*>(out), got));
  member_bytes_ += static_cast<std::uint32_t>(got);
  offset_ += static_cast<std::int64_t>(got);
  if (status == Z_STREAM_END)
  {
    part_ = Part::Trailer;
  }
  return got;
}

/// Makes a point of where inflate stopped, if that is between two blocks of deflate.
void GzipDecoder::note_point()
{
  constexpr int between_blocks = 128;
  constexpr int in_last_block = 64;
  constexpr int bits = 7;
  const int state = inflate_->data_type;
  if ((state & between_blocks) == 0 || (state & in_last_block) != 0)
  {
    return;
  }
  std::string window(window_bytes, '\0');
  uInt length = 0;
  inflateGetDictionary(inflate_.get(), reinterpret_cast<Bytef*>(window.data()), &length);
  if (length == 0)
  {
    return; // an empty block first: would look like the start of a member
  }
  window.resize(length);
  this->add_point({ offset_, in_.position(), static_cast<std::uint8_t>(state & bits), check_,
    member_bytes_, std::move(window) });
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

std::unique_ptr<Decoder> make_gzip_decoder(const ByteSource& packed, SeekPoints& points)
{
  return std::make_unique<GzipDecoder>(packed, points);
}
}
