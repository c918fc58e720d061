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

/// One gzip member or one zstd frame that holds the bytes: members one after the other are a file. Equal
/// bytes give equal members. From any thread. Throws UnsupportedError if the library that is there
/// refuses, and std::bad_alloc.
std::string compress(std::string_view bytes, Compression how);

/// Decompresses data in zlib's format (RFC 1950), which must fill the bytes. False: they do not, or are damaged. Throws
/// std::bad_alloc.
bool decompress_zlib(std::string_view packed, std::span<char> bytes);
}
#endif
