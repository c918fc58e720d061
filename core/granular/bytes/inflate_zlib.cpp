// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/inflate.h"

#include <algorithm>
#include <limits>
#include <new>

#define ZLIB_CONST
#include <zlib.h>

namespace granular
{
namespace
{
class ZlibInflate final : public Inflate
{
public:
  ZlibInflate()
  {
    constexpr int raw_deflate = -15; // and windows of 2^15 bytes
    if (inflateInit2(&stream_, raw_deflate) != Z_OK)
    {
      throw std::bad_alloc();
    }
  }
  ZlibInflate(const ZlibInflate&) = delete;
  ZlibInflate& operator=(const ZlibInflate&) = delete;
  ~ZlibInflate() override { inflateEnd(&stream_); }

  void start() override { inflateReset(&stream_); }

  void start(int bits, unsigned byte, std::string_view window) override
  {
    inflateReset(&stream_);
    if (bits > 0)
    {
      inflatePrime(&stream_, bits, static_cast<int>(byte >> (8 - bits)));
    }
    inflateSetDictionary(
      &stream_, reinterpret_cast<const Bytef*>(window.data()), static_cast<uInt>(window.size()));
  }

  Step inflate(std::string_view input, std::span<char> output, bool to_block) override
  {
    constexpr std::size_t most = std::numeric_limits<uInt>::max();
    const auto in = static_cast<uInt>(std::min(input.size(), most));
    const auto out = static_cast<uInt>(std::min(output.size(), most));
    stream_.next_in = reinterpret_cast<const Bytef*>(input.data());
    stream_.avail_in = in;
    stream_.next_out = reinterpret_cast<Bytef*>(output.data());
    stream_.avail_out = out;
    const int status = ::inflate(&stream_, to_block ? Z_BLOCK : Z_NO_FLUSH);
    if (status == Z_MEM_ERROR)
    {
      throw std::bad_alloc();
    }
    Step step;
    step.read = static_cast<std::ptrdiff_t>(in - stream_.avail_in);
    step.written = out - stream_.avail_out;
    step.ended = status == Z_STREAM_END;
    if (status != Z_OK && status != Z_BUF_ERROR && status != Z_STREAM_END)
    {
      step.damage = stream_.msg != nullptr ? stream_.msg : "not known to zlib";
    }
    constexpr int between_blocks = 128;
    constexpr int in_last_block = 64;
    constexpr int bits = 7;
    const int state = stream_.data_type;
    if (to_block && (state & between_blocks) != 0 && (state & in_last_block) == 0)
    {
      step.block_bits = state & bits;
    }
    return step;
  }

  std::uint32_t check(std::uint32_t before, std::string_view bytes) const noexcept override
  {
    return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  }

private:
  z_stream stream_ = {};
};

constexpr Inflation all[] = {
#ifdef GRANULAR_ISAL
  { "isal", make_isal_inflate },
#endif
  { "zlib", make_zlib_inflate },
};
}

std::unique_ptr<Inflate> make_zlib_inflate()
{
  return std::make_unique<ZlibInflate>();
}

std::span<const Inflation> inflations() noexcept
{
  return all;
}
}
