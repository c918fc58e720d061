// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_text_row_text_detail_h
#define granular_text_row_text_detail_h

// Parts, batches and tables that the decoders of the instruction sets share. Only for row_text*.cpp.

#include "granular/numbers/decimal.h"
#include "granular/numbers/number.h"
#include "granular/numbers/number_scan.h"
#include "granular/text/row_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <type_traits>

namespace granular::row_text
{
struct RowPlan
{
  std::span<ColumnSink> sinks;
  std::uint32_t columns;
  bool loose;
  RowMemory& memory;
};

void store_text(const char* first, const char* last, char* data) noexcept;

/// Continues from `result`, word by word, until it has max_rows rows, the text ends, or a word is invalid.
void decode_plain(
  const char* last, RowPlan& plan, std::int64_t max_rows, RowResult& result) noexcept;

inline constexpr std::ptrdiff_t batch_bytes = 16384;

/// The edges of words in up to batch_bytes of text, with some extra room because groups are written without checks.
struct Edges
{
  std::uint32_t count;
  std::uint32_t lines;
  alignas(64) std::uint16_t offsets[batch_bytes + 128];
  alignas(64) std::uint16_t line_ends[batch_bytes + 128];
};

/// The lines of a batch: where each ends, and how many words it has.
struct Lines
{
  std::uint32_t count;
  std::uint16_t ends[batch_bytes];
  std::uint16_t words[batch_bytes];
};

/// The rows of a batch, by the index of their first edge.
struct Rows
{
  std::uint32_t count;
  std::uint32_t end; ///< offset of the line behind the last row
  std::uint16_t first_edges[batch_bytes / 2];
};

/// The words of some columns of a batch, and the bits of their values.
struct Words
{
  std::uint32_t count;
  alignas(64) std::uint16_t edges[batch_bytes + 128];
  alignas(64) std::uint64_t values[batch_bytes / 2 + 8];
};

/// State of a batch for the decoders.
struct Batch
{
  Edges edges;
  Lines lines;
  Rows rows;
  Words words;
};

#if GRANULAR_X86
/// The places of the bits of a byte, in order.
alignas(64) inline constexpr auto bit_places = []
{
  std::array<std::array<std::uint8_t, 8>, 256> places{};
  for (std::size_t byte = 0; byte < places.size(); ++byte)
  {
    std::size_t count = 0;
    for (std::uint8_t bit = 0; bit < 8; ++bit)
    {
      if ((byte >> bit & 1) != 0)
      {
        places[byte][count++] = bit;
      }
    }
  }
  return places;
}();

/// Returns eight characters. Compilers do not see this in load_eight where many are side by side.
inline std::uint64_t load_at_once(const char* first) noexcept
{
  std::uint64_t bytes;
  std::memcpy(&bytes, first, sizeof bytes);
  return bytes;
}

struct BlockMarks
{
  std::uint64_t words; ///< bytes above ' '
  std::uint64_t lines; ///< line feeds
};

namespace avx2
{
RowResult decode(
  const char* first, const char* last, RowPlan& plan, std::int64_t max_rows) noexcept;
}

namespace avx512
{
RowResult decode(
  const char* first, const char* last, RowPlan& plan, std::int64_t max_rows) noexcept;
}
#endif
}
#endif
