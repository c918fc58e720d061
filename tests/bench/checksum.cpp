// SPDX-License-Identifier: BSD-3-Clause
#include "checksum.h"

#define ZLIB_CONST
#include <zlib.h>

namespace bench
{
std::string checksums(const Output& output, std::int64_t rows, std::int64_t first_row)
{
  std::string text;
  for (std::size_t i = 0; i < output.arrays(); ++i)
  {
    const auto* const bytes = reinterpret_cast<const Bytef*>(output.array(i));
    const std::size_t size = static_cast<std::size_t>(rows) * output.bytes_a_row(i);
    const std::size_t first = static_cast<std::size_t>(first_row) * output.bytes_a_row(i);
    const uLong sum = crc32_z(crc32_z(0, bytes + first, size - first), bytes, first);
    text += (i > 0 ? " " : "") + std::to_string(sum);
  }
  return text;
}
}
