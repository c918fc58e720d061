// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_vtk_files_base64_h
#define granular_vtk_files_base64_h

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace granular
{
/// Returns the number of characters of base64 (RFC 4648, padded) for this many bytes.
constexpr std::size_t base64_chars(std::size_t bytes) noexcept
{
  return bytes / 3 * 4 + (bytes % 3 != 0 ? 4 : 0);
}

/// Decodes this many bytes from the beginning of text; at most base64_chars(bytes) characters are read. Returns nothing
/// if the text is too short or is not base64.
std::optional<std::string> decode_base64(std::string_view text, std::size_t bytes);
}
#endif
