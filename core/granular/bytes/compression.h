// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bytes_compression_h
#define granular_bytes_compression_h

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace granular
{
enum class Compression : std::uint8_t
{
  None,
  Gzip, ///< level 6, without name and time
  Zstd  ///< level 3, with checksum
};

/// Returns one gzip member or one Zstandard frame that holds the bytes. Concatenated members make a file, and equal
/// bytes give equal members. May be called from any thread. Throws UnsupportedError if the compression library refuses,
/// and std::bad_alloc.
std::string compress(std::string_view bytes, Compression how);

/// Decompresses data in zlib's format (RFC 1950) into `bytes`, which the content must fill exactly. Returns false if it
/// does not or if the data are damaged. Throws std::bad_alloc.
bool decompress_zlib(std::string_view packed, std::span<char> bytes);
}
#endif
