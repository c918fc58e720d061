// SPDX-License-Identifier: BSD-3-Clause
// For byte_source_gzip.cpp alone.
#ifndef granular_bytes_gzip_header_h
#define granular_bytes_gzip_header_h

#include "granular/bytes/byte_source_unpack.h"
#include "granular/bytes/inflate.h"

#include <cstdint>
#include <string>

namespace granular
{
/// Passes over the header of a gzip member (RFC 1952). Returns false if the file ends within it. Throws FormatError.
bool pass_gzip_header(PackedInput& in, const Inflate& inflate);

/// Returns a number as users know sums: 0x and hexadecimal digits.
std::string hexadecimal(std::uint32_t value);
}
#endif
