// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_base_row_text_tables_h
#define granular_base_row_text_tables_h

// Batches and tables of the decoders for x86. Only for row_text_*.cpp.

#include "granular/base/decimal.h"
#include "granular/base/number.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace granular::row_text
{
inline constexpr std::ptrdiff_t batch_bytes = 16384;

/// Edges of words in up to batch_bytes of text; a little room more, since they are written in
/// groups without looking.
struct Edges
{
  std::uint32_t count;
  std::uint32_t lines;
  alignas(64) std::uint16_t offsets[batch_bytes + 128];
  alignas(64) std::uint16_t line_ends[batch_bytes + 128];
};

/// Rows of a batch, by the index of their first edge.
struct Rows
{
  std::uint32_t count;
  std::uint32_t end; ///< offset of the line behind the last row
  bool surplus;      ///< a row had more words than columns
  std::uint16_t first_edges[batch_bytes / 2];
};

struct BlockMarks
{
  std::uint64_t words; ///< bytes above ' '
  std::uint64_t lines; ///< line feeds
};

/// &keep_last[n] is a mask of 32 bytes that keeps the last n, &keep_last[16 + n] one of 16 bytes.
inline constexpr auto keep_last = []
{
  std::array<std::uint8_t, 64> masks{};
  std::fill(masks.begin() + 32, masks.end(), std::uint8_t{ 0xff });
  return masks;
}();

/// drop_point[p] moves the bytes before position p up by one, over it; 16 moves none.
struct alignas(16) Shuffle : std::array<std::uint8_t, 16>
{
};

inline constexpr auto drop_point = []
{
  std::array<Shuffle, 17> shuffles{};
  for (std::size_t p = 0; p < 17; ++p)
  {
    for (std::size_t i = 0; i < 16; ++i)
    {
      const std::size_t from = p < 16 && i <= p ? i - 1 : i;
      shuffles[p][i] = p < 16 && i == 0 ? std::uint8_t{ 0x80 } : static_cast<std::uint8_t>(from);
    }
  }
  return shuffles;
}();

/// Digits behind a point at position p of 16.
inline constexpr auto digits_behind = []
{
  std::array<std::int8_t, 17> counts{};
  for (int p = 0; p < 16; ++p)
  {
    counts[static_cast<std::size_t>(p)] = static_cast<std::int8_t>(15 - p);
  }
  return counts;
}();

/// 10^0 to 10^22: those that a double holds exactly.
inline constexpr auto powers_of_ten = []
{
  std::array<double, 23> powers{};
  double power = 1;
  for (double& entry : powers)
  {
    entry = power;
    power *= 10;
  }
  return powers;
}();

/// 10^p as a factor or a divisor, both exact.
struct Scale
{
  double factor;
  double divisor;
};

inline constexpr auto scales = []
{
  std::array<Scale, 45> table{};
  for (std::size_t p = 0; p <= 22; ++p)
  {
    table[22 + p] = { powers_of_ten[p], 1 };
    table[22 - p] = { 1, powers_of_ten[p] };
  }
  return table;
}();

/// digits * 10^power, rounded once. False where that takes more than a double or a wide product.
inline bool scale(std::uint64_t digits, int power, double& value) noexcept
{
  if (digits >> 53 == 0 && static_cast<unsigned>(power + 22) <= 44u)
  {
    // both operands are exact, and one of the two factors is 1
    const Scale factors = scales[static_cast<std::size_t>(power + 22)];
    value =
      static_cast<double>(static_cast<std::int64_t>(digits)) * factors.factor / factors.divisor;
    return true;
  }
  return digits != 0 && nearest_double(digits, power, value);
}
}
#endif
