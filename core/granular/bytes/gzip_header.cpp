// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_source_unpack.h"
#include "granular/bytes/inflate.h"
#include "granular/common/error.h"

#include <array>
#include <charconv>

namespace granular
{
namespace
{
/// The fields of a member's header, with the CRC of what was read of it.
struct HeaderBytes
{
  PackedInput& in;
  const Inflate& inflate;
  std::uint32_t check = 0;
  bool ended = false;

  /// 0 once the file has ended.
  unsigned get()
  {
    const int next = in.get();
    ended = ended || next < 0;
    const auto byte = static_cast<unsigned char>(ended ? 0 : next);
    check = inflate.check(check, { reinterpret_cast<const char*>(&byte), 1 });
    return byte;
  }

  unsigned get_16()
  {
    const unsigned low = this->get();
    return low | this->get() << 8;
  }

  void skip(unsigned bytes)
  {
    for (; bytes > 0 && !ended; --bytes)
    {
      this->get();
    }
  }
};
}

std::string hexadecimal(std::uint32_t value)
{
  std::array<char, 8> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, 16).ptr;
  return "0x" + std::string(digits.data(), end);
}

bool pass_gzip_header(PackedInput& in, const Inflate& inflate)
{
  enum : unsigned
  {
    has_check = 2,
    has_extra = 4,
    has_name = 8,
    has_comment = 16,
    reserved = 0xe0
  };
  HeaderBytes header{ in, inflate };
  const Where where{ in.path(), 0, in.position() };
  for (const unsigned expected : { 0x1fu, 0x8bu, 0x08u })
  {
    if (header.get() != expected && !header.ended)
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
  for (const unsigned text : { has_name, has_comment })
  {
    while ((flags & text) != 0 && header.get() != 0)
    {
    }
  }
  const unsigned check = header.check & 0xffff;
  if ((flags & has_check) != 0 && header.get_16() != check && !header.ended)
  {
    throw FormatError("expected a gzip header that fits its CRC, got another", where);
  }
  return !header.ended;
}
}
