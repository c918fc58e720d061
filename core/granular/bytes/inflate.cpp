// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/byte_source_unpack.h"

#include <algorithm>
#include <limits>
#include <new>

#define ZLIB_CONST
#include <zlib.h>
#ifdef GRANULAR_ISAL
#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>
#endif

namespace granular
{
namespace
{
#ifdef GRANULAR_ISAL
/// The library takes the header of a block when it has all of it, and keeps where it began until then. While a block is looked
/// for, it gets less at a time than most headers have, so that it stops within them. Not 1 byte: each call moves the window.
constexpr std::size_t less_than_a_header = 16;

/// Takes half of the time of zlib, or less.
class IsalInflate final : public Inflate
{
public:
  IsalInflate() { isal_inflate_init(&state_); }

  void start() override { isal_inflate_reset(&state_); }

  void start(int bits, unsigned byte, std::string_view window) override
  {
    isal_inflate_reset(&state_);
    state_.read_in = bits > 0 ? byte >> (8 - bits) : 0;
    state_.read_in_length = bits;
    isal_inflate_set_dict(&state_, bytes_of(window), static_cast<std::uint32_t>(window.size()));
  }

  Step inflate(std::string_view input, std::span<char> output, bool to_block) override
  {
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max();
    const auto in =
      static_cast<std::uint32_t>(std::min(input.size(), to_block ? less_than_a_header : most));
    const auto out = static_cast<std::uint32_t>(std::min(output.size(), most));
    state_.next_in = bytes_of(input);
    state_.avail_in = in;
    state_.next_out = reinterpret_cast<std::uint8_t*>(output.data());
    state_.avail_out = out;
    const int status = isal_inflate(&state_);
    Step step;
    step.read = state_.next_in - bytes_of(input);
    step.written = out - state_.avail_out;
    step.ended = state_.block_state == ISAL_BLOCK_FINISH;
    if (status != ISAL_DECOMP_OK)
    {
      step.damage = reason(status);
    }
    if (step.ended || step.damage != nullptr)
    {
      step.read -= state_.read_in_length / 8; // it reads ahead
      state_.read_in_length = 0;
    }
    const bool all_written = state_.tmp_out_valid == state_.tmp_out_processed;
    if (to_block && state_.block_state == ISAL_BLOCK_HDR && all_written)
    {
      step.block_bits = 8 * state_.tmp_in_size + state_.read_in_length;
    }
    return step;
  }

  std::uint32_t check(std::uint32_t before, std::string_view bytes) const noexcept override
  {
    return crc32_gzip_refl(before, bytes_of(bytes), bytes.size());
  }

private:
  /// The library's interface has no const; it changes nothing.
  static std::uint8_t* bytes_of(std::string_view bytes) noexcept
  {
    return reinterpret_cast<std::uint8_t*>(const_cast<char*>(bytes.data()));
  }

  static const char* reason(int status) noexcept
  {
    switch (status)
    {
      case ISAL_INVALID_BLOCK:
        return "invalid block type or code lengths";
      case ISAL_INVALID_SYMBOL:
        return "invalid code";
      case ISAL_INVALID_LOOKBACK:
        return "invalid distance too far back";
      default:
        return "not known to ISA-L";
    }
  }

  inflate_state state_;
};
#endif

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

template <class Library>
std::unique_ptr<Inflate> make()
{
  return std::make_unique<Library>();
}

constexpr Inflation all[] = {
#ifdef GRANULAR_ISAL
  { "isal", make<IsalInflate> },
#endif
  { "zlib", make<ZlibInflate> },
};
}

std::span<const Inflation> inflations() noexcept
{
  return all;
}
}
