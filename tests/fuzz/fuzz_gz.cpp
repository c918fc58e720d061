// SPDX-License-Identifier: BSD-3-Clause
// A gzip file from memory, against zlib. The mutator changes the content and packs it again: other levels, strategies, blocks,
// members and header fields.
#include "packed_checks.h"

#include <zlib.h>

using namespace granular;
using namespace granular::fuzz;

namespace
{
constexpr int gzip_only = 31; // windows of 2^15 bytes, and a gzip header

Bytef* bytes_of(std::string& text)
{
  return reinterpret_cast<Bytef*>(text.data());
}

/// Members one after the other, with zeros between them, as far as they go.
Reference unpack_with_zlib(std::string packed, std::size_t most)
{
  Reference all;
  std::string buffer(1 << 16, '\0');
  for (std::size_t at = 0; all.end == Reference::End::Whole && all.text.size() < most;)
  {
    at = std::min(packed.find_first_not_of('\0', at), packed.size());
    if (at == packed.size())
    {
      break;
    }
    constexpr std::string_view magic = "\x1f\x8b\x08";
    if (magic.substr(0, packed.size() - at) != std::string_view(packed).substr(at, magic.size()))
    {
      all.end = Reference::End::Damaged; // zlib would wait for a second byte
      break;
    }
    z_stream stream = {};
    require(inflateInit2(&stream, gzip_only) == Z_OK, "inflateInit2");
    stream.next_in = bytes_of(packed) + at;
    stream.avail_in = static_cast<uInt>(packed.size() - at);
    int status = Z_OK;
    while (status == Z_OK && all.text.size() < most)
    {
      stream.next_out = bytes_of(buffer);
      stream.avail_out = static_cast<uInt>(buffer.size());
      status = inflate(&stream, Z_NO_FLUSH);
      all.text.append(buffer, 0, buffer.size() - stream.avail_out);
    }
    at = packed.size() - stream.avail_in;
    inflateEnd(&stream);
    all.end = status == Z_STREAM_END || status == Z_OK ? Reference::End::Whole
      : status == Z_BUF_ERROR                          ? Reference::End::Cut
                                                       : Reference::End::Damaged;
  }
  return all;
}

/// One member that holds the content, in one of the many ways there are.
std::string pack(std::string content, Random& random)
{
  constexpr int strategies[] = { Z_DEFAULT_STRATEGY, Z_FILTERED, Z_HUFFMAN_ONLY, Z_RLE, Z_FIXED };
  constexpr int flushes[] = { Z_NO_FLUSH, Z_BLOCK, Z_PARTIAL_FLUSH, Z_SYNC_FLUSH, Z_FULL_FLUSH };
  z_stream stream = {};
  require(deflateInit2(&stream, static_cast<int>(below(random, 10)), Z_DEFLATED, gzip_only,
            static_cast<int>(below(random, 9)) + 1,
            strategies[below(random, std::size(strategies))]) == Z_OK,
    "deflateInit2");
  std::string field(below(random, 40), 'f');
  gz_header header = {};
  if (one_in(random, 3))
  {
    header.extra = one_in(random, 2) ? bytes_of(field) : nullptr;
    header.extra_len = static_cast<uInt>(field.size());
    header.name = one_in(random, 2) ? bytes_of(field) : nullptr;
    header.comment = one_in(random, 2) ? bytes_of(field) : nullptr;
    header.hcrc = one_in(random, 2) ? 1 : 0;
    deflateSetHeader(&stream, &header);
  }
  std::string packed(2 * content.size() + (1 << 16), '\0');
  stream.next_out = bytes_of(packed);
  stream.avail_out = static_cast<uInt>(packed.size());
  stream.next_in = bytes_of(content);
  for (std::size_t blocks = below(random, 6), left = content.size(); blocks > 0; --blocks)
  {
    stream.avail_in = static_cast<uInt>(below(random, left + 1));
    left -= stream.avail_in;
    deflate(&stream, flushes[below(random, std::size(flushes))]);
    left += stream.avail_in;
  }
  stream.avail_in = static_cast<uInt>(bytes_of(content) + content.size() - stream.next_in);
  const int status = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return status == Z_STREAM_END ? packed : std::string();
}

}

void fuzz::mutate(std::string& bytes, Random& random, std::size_t most)
{
  mutate_packed(bytes, random, most, unpack_with_zlib, pack,
    [](Random& chance) { return std::string(one_in(chance, 4) ? below(chance, 8) : 0, '\0'); });
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view packed(reinterpret_cast<const char*>(data), size);
  if (packed.starts_with("\x1f\x8b\x08"))
  {
    check_packed(packed, unpack_with_zlib(std::string(packed), most_content), true);
  }
  return 0;
}
