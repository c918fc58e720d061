// SPDX-License-Identifier: BSD-3-Clause
// A Zstandard file from memory, against the library. The mutator changes the content and packs it again: other levels, windows,
// blocks, frames and header fields, and frames to be passed over.
#include "packed_checks.h"

#include <zstd.h>

using namespace granular;
using namespace granular::fuzz;

namespace
{
constexpr int largest_window = 27; // that the reader takes

struct FreeContext
{
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};

/// Says whether the library finds so much content in a frame. Decompressed as a whole, a frame shows damage that the streaming
/// decoder passes over.
bool holds(std::string_view frame, std::size_t content)
{
  std::string buffer(content, '\0');
  return ZSTD_decompress(buffer.data(), content, frame.data(), frame.size()) == content;
}

/// Frames one after the other, as far as they go. Byte by byte: of a frame as a whole, the library takes a window of any size.
Reference unpack_with_zstd(std::string_view packed, std::size_t most)
{
  const std::unique_ptr<ZSTD_DCtx, FreeContext> context(ZSTD_createDCtx());
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, largest_window);
  Reference all;
  std::string buffer(1 << 16, '\0');
  ZSTD_inBuffer input{ packed.data(), 0, 0 };
  std::size_t status = 0;
  bool full = false;     // there may be more content without more input
  std::size_t frame = 0; // where it begins
  std::size_t content = 0;
  while ((input.pos < packed.size() || full) && all.text.size() < most)
  {
    input.size = std::min(input.pos + 1, packed.size());
    ZSTD_outBuffer output{ buffer.data(), buffer.size(), 0 };
    status = ZSTD_decompressStream(context.get(), &output, &input);
    if (ZSTD_isError(status))
    {
      all.end = Reference::End::Damaged;
      return all;
    }
    all.text.append(buffer, 0, output.pos);
    content += output.pos;
    const std::string_view rest = packed.substr(frame);
    const auto claimed = ZSTD_getFrameContentSize(rest.data(), rest.size());
    if ((claimed < ZSTD_CONTENTSIZE_ERROR && content > claimed) ||
      (status == 0 && !holds(rest.substr(0, input.pos - frame), content)))
    {
      all.end = Reference::End::Damaged;
      return all;
    }
    if (status == 0)
    {
      frame = input.pos;
      content = 0;
    }
    full = output.pos == output.size && status != 0;
  }
  all.end = status == 0 ? Reference::End::Whole : Reference::End::Cut;
  return all;
}

/// One frame that holds the content, in one of the many ways there are.
std::string pack(std::string_view content, Random& random)
{
  const std::unique_ptr<ZSTD_CCtx, FreeContext> context(ZSTD_createCCtx());
  const auto set = [&](ZSTD_cParameter parameter, std::size_t value)
  { ZSTD_CCtx_setParameter(context.get(), parameter, static_cast<int>(value)); };
  set(ZSTD_c_compressionLevel, below(random, 8));
  set(ZSTD_c_checksumFlag, below(random, 2));
  set(ZSTD_c_contentSizeFlag, below(random, 2));
  if (one_in(random, 2))
  {
    set(ZSTD_c_windowLog, 10 + below(random, 10));
    set(ZSTD_c_strategy, 1 + below(random, 6));
  }
  std::string packed(ZSTD_compressBound(content.size()) + 4096, '\0');
  ZSTD_outBuffer output{ packed.data(), packed.size(), 0 };
  ZSTD_inBuffer input{ content.data(), 0, 0 };
  for (std::size_t blocks = below(random, 6); blocks > 0; --blocks)
  {
    input.size += below(random, content.size() - input.size + 1);
    ZSTD_compressStream2(
      context.get(), &output, &input, one_in(random, 2) ? ZSTD_e_flush : ZSTD_e_continue);
  }
  input.size = content.size();
  if (ZSTD_compressStream2(context.get(), &output, &input, ZSTD_e_end) != 0)
  {
    return {};
  }
  packed.resize(output.pos);
  return packed;
}

/// A frame without content.
std::string skippable(Random& random)
{
  std::string frame(1, static_cast<char>(0x50 + below(random, 16)));
  frame += "\x2a\x4d\x18";
  const auto size = static_cast<std::uint32_t>(below(random, 20));
  append(frame, size);
  return frame.append(size, 's');
}

}

void fuzz::mutate(std::string& bytes, Random& random, std::size_t most)
{
  mutate_packed(bytes, random, most, unpack_with_zstd, pack,
    [](Random& chance) { return one_in(chance, 6) ? skippable(chance) : std::string(); });
  if (one_in(random, 6))
  {
    bytes.insert(0, skippable(random));
  }
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string_view packed(reinterpret_cast<const char*>(data), size);
  if (!packed.starts_with("\x1f\x8b"))
  {
    check_packed(packed, unpack_with_zstd(packed, most_content), false);
  }
  return 0;
}
