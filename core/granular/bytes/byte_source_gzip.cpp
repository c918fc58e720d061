// SPDX-License-Identifier: BSD-3-Clause
// gzip, RFC 1952. A library inflates; header and trailer are read here, since none checks them in what is inflated from the
// middle on.
#include "granular/bytes/byte_source_unpack.h"
#include "granular/bytes/inflate.h"

#include "granular/common/error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace granular
{
namespace
{
constexpr std::size_t window_bytes = std::size_t{ 1 } << 15;

/// The fields of a member's header, with the CRC of what was read of it.
class HeaderBytes
{
public:
  HeaderBytes(PackedInput& in, const Inflate& inflate)
    : in_(in)
    , inflate_(inflate)
  {
  }

  /// 0 once the file has ended.
  unsigned get()
  {
    const int next = in_.get();
    ended_ = ended_ || next < 0;
    const auto byte = static_cast<unsigned char>(ended_ ? 0 : next);
    check_ = inflate_.check(check_, { reinterpret_cast<const char*>(&byte), 1 });
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
  const Inflate& inflate_;
  std::uint32_t check_ = 0;
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
  GzipDecoder(const ByteSource& packed, SeekPoints& points, const Inflation& inflation)
    : Decoder(packed, points)
    , inflate_(inflation.make())
  {
  }

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
  std::size_t inflate_some(std::span<char> out, bool to_block);
  std::optional<std::uint32_t> read_32();
  bool read_trailer();
  void remember(std::string_view content);
  void note_point(int bits);

  std::unique_ptr<Inflate> inflate_;
  Part part_ = Part::Header;
  std::uint32_t check_ = 0;        ///< CRC-32 of the member so far
  std::uint32_t member_bytes_ = 0; ///< of the member so far, modulo 2^32
  std::string last_; ///< bytes of the member: at least a window of them where a point is due
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
  HeaderBytes header(in_, *inflate_);
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
  inflate_->start();
  last_.clear();
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
  std::size_t done = 0;
  while (part_ == Part::Data && done < bytes)
  {
    const bool more = in_.more();
    // Up to where a point is due at full speed, then to the end of the block of deflate: only there
    // can it start. A block may be long - nothing limits it, common writers end it after some 100
    // KiB of content - and the next point is then as far away.
    const std::int64_t left = this->to_next_point();
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
  if (step.ended)
  {
    part_ = Part::Trailer;
  }
  else if (step.block_bits && !last_.empty()) // empty: would look like the start of a member
  {
    this->note_point(*step.block_bits);
  }
  return content.size();
}

/// Keeps the content that a point needs, from where one is near.
void GzipDecoder::remember(std::string_view content)
{
  if (this->to_next_point() > static_cast<std::int64_t>(2 * window_bytes))
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
  const ByteSource& packed, SeekPoints& points, const Inflation& inflation)
{
  return std::make_unique<GzipDecoder>(packed, points, inflation);
}
}
