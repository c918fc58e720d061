// SPDX-License-Identifier: BSD-3-Clause
// ISA-L takes half of the time of zlib, or less.
#ifdef GRANULAR_ISAL
#include "granular/bytes/inflate.h"

#include <algorithm>
#include <limits>

#include <isa-l/crc.h>
#include <isa-l/igzip_lib.h>

namespace granular
{
namespace
{
/// The library takes the header of a block when it has all of it, and keeps where it began until then. While a block is looked
/// for, it gets less at a time than most headers have, so that it stops within them. Not 1 byte: each call moves the window.
constexpr std::size_t less_than_a_header = 16;

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
}

std::unique_ptr<Inflate> make_isal_inflate()
{
  return std::make_unique<IsalInflate>();
}
}
#endif
