// SPDX-License-Identifier: BSD-3-Clause
#include "granular/bytes/compression.h"

#include "granular/common/error.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <new>

#define ZLIB_CONST
#include <zlib.h>
#include <zstd.h>
#include <zstd_errors.h>

namespace granular
{
namespace
{
void check_zlib(int status)
{
  if (status == Z_MEM_ERROR)
  {
    throw std::bad_alloc();
  }
  if (status != Z_OK && status != Z_STREAM_END)
  {
    throw UnsupportedError(std::string("cannot compress with zlib: ") + zError(status));
  }
}

struct EndDeflate
{
  void operator()(z_stream* stream) const noexcept { deflateEnd(stream); }
};

std::string gzip(std::string_view bytes)
{
  constexpr int gzip_window = 15 + 16; // the largest, in gzip's format
  constexpr int usual_memory = 8;
  z_stream stream = {};
  check_zlib(deflateInit2(
    &stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip_window, usual_memory, Z_DEFAULT_STRATEGY));
  const std::unique_ptr<z_stream, EndDeflate> end(&stream);

  std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  std::string_view in = bytes;
  std::size_t out = 0;
  for (int status = Z_OK; status != Z_STREAM_END;)
  {
    // zlib counts in unsigned
    constexpr std::size_t most = std::numeric_limits<uInt>::max();
    const auto give = static_cast<uInt>(std::min(in.size(), most));
    const auto room = static_cast<uInt>(std::min(packed.size() - out, most));
    stream.next_in = reinterpret_cast<const Bytef*>(in.data());
    stream.avail_in = give;
    stream.next_out = reinterpret_cast<Bytef*>(packed.data() + out);
    stream.avail_out = room;
    status = deflate(&stream, give == in.size() ? Z_FINISH : Z_NO_FLUSH);
    check_zlib(status);
    in.remove_prefix(give - stream.avail_in);
    out += room - stream.avail_out;
  }
  packed.resize(out);
  return packed;
}

std::size_t check_zstd(std::size_t result)
{
  if (!ZSTD_isError(result))
  {
    return result;
  }
  if (ZSTD_getErrorCode(result) == ZSTD_error_memory_allocation)
  {
    throw std::bad_alloc();
  }
  throw UnsupportedError(std::string("cannot compress with zstd: ") + ZSTD_getErrorName(result));
}

struct FreeContext
{
  void operator()(ZSTD_CCtx* context) const noexcept { ZSTD_freeCCtx(context); }
};

std::string zstd(std::string_view bytes)
{
  constexpr int level = 3;
  const std::unique_ptr<ZSTD_CCtx, FreeContext> context(ZSTD_createCCtx());
  if (!context)
  {
    throw std::bad_alloc();
  }
  check_zstd(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level));
  check_zstd(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1));
  std::string packed(check_zstd(ZSTD_compressBound(bytes.size())), '\0');
  packed.resize(check_zstd(
    ZSTD_compress2(context.get(), packed.data(), packed.size(), bytes.data(), bytes.size())));
  return packed;
}
}

std::string compress(std::string_view bytes, Compression how)
{
  std::string packed;
  switch (how)
  {
    case Compression::None:
      return std::string(bytes);
    case Compression::Gzip:
      packed = gzip(bytes);
      break;
    case Compression::Zstd:
      packed = zstd(bytes);
      break;
  }
  packed.shrink_to_fit(); // many may wait to be written
  return packed;
}

bool decompress_zlib(std::string_view packed, std::span<char> bytes)
{
  auto size = static_cast<uLongf>(bytes.size()); // Windows has 32 bits for it
  auto used = static_cast<uLong>(packed.size());
  const int status = uncompress2(reinterpret_cast<Bytef*>(bytes.data()), &size,
    reinterpret_cast<const Bytef*>(packed.data()), &used);
  if (status == Z_MEM_ERROR)
  {
    throw std::bad_alloc();
  }
  return status == Z_OK && size == bytes.size();
}
}
