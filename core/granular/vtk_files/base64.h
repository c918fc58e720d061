// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_vtk_files_base64_h
#define granular_vtk_files_base64_h

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace granular
{
/// How many characters of base64 (RFC 4648, padded) so many bytes become.
constexpr std::size_t base64_chars(std::size_t bytes) noexcept
{
  return bytes / 3 * 4 + (bytes % 3 != 0 ? 4 : 0);
}

/// Decodes the bytes that text begins with, at most base64_chars(bytes) of which are looked at. Nothing where these
/// are not there, or no base64.
std::optional<std::string> decode_base64(std::string_view text, std::size_t bytes);
}
#endif
