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
#include <limits>
#include <type_traits>

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

/// Words of some columns of a batch, and the bits of their values.
struct Words
{
  std::uint32_t count;
  alignas(64) std::uint16_t edges[batch_bytes + 128];
  alignas(64) std::uint64_t values[batch_bytes / 2 + 8];
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
}
#endif
