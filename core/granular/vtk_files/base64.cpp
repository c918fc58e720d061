// SPDX-License-Identifier: BSD-3-Clause
#include "granular/vtk_files/base64.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace granular
{
namespace
{
constexpr std::string_view alphabet =
  "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t no_digit = 64;

constexpr std::array<std::uint8_t, 256> make_digits() noexcept
{
  std::array<std::uint8_t, 256> digits = {};
  digits.fill(no_digit);
  for (std::size_t i = 0; i < alphabet.size(); ++i)
  {
    digits[static_cast<unsigned char>(alphabet[i])] = static_cast<std::uint8_t>(i);
  }
  return digits;
}

constexpr std::array<std::uint8_t, 256> digits = make_digits();
}

std::optional<std::string> decode_base64(std::string_view text, std::size_t bytes)
{
  // the first is checked before the second may be too large
  if (bytes / 3 > text.size() / 4 || base64_chars(bytes) > text.size())
  {
    return std::nullopt;
  }
  std::string decoded(bytes, '\0');
  for (std::size_t from = 0, to = 0; to < bytes; from += 4, to += 3)
  {
    const std::size_t wanted = std::min<std::size_t>(3, bytes - to);
    std::uint32_t all = 0;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const std::uint8_t digit = digits[static_cast<unsigned char>(text[from + i])];
      const bool padding = i > wanted && text[from + i] == '=';
      if (digit == no_digit && !padding)
      {
        return std::nullopt;
      }
      all = all << 6 | (padding ? 0U : digit);
    }
    for (std::size_t i = 0; i < wanted; ++i)
    {
      decoded[to + i] = static_cast<char>(all >> (16 - 8 * i) & 0xff);
    }
  }
  return decoded;
}
}
