// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/row_text_detail.h"

#if GRANULAR_X86

#include "granular/base/row_text_tables.h"

#include <immintrin.h>

namespace granular::row_text::avx2
{
namespace
{
#define GRANULAR_TARGET __attribute__((target("avx2,bmi,bmi2,popcnt")))

GRANULAR_TARGET inline BlockMarks mark_block(const char* block) noexcept
{
  const __m256i low = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(block));
  const __m256i high = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(block + 32));
  const auto mask = [](__m256i a, __m256i b) GRANULAR_TARGET
  {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm256_movemask_epi8(a))) |
      static_cast<std::uint64_t>(static_cast<std::uint32_t>(_mm256_movemask_epi8(b))) << 32;
  };
  const __m256i first = _mm256_set1_epi8(' ' + 1);
  const __m256i feed = _mm256_set1_epi8('\n');
  return { mask(_mm256_cmpeq_epi8(_mm256_max_epu8(low, first), low),
             _mm256_cmpeq_epi8(_mm256_max_epu8(high, first), high)),
    mask(_mm256_cmpeq_epi8(low, feed), _mm256_cmpeq_epi8(high, feed)) };
}

/// Appends the places of the bits, eight at a time: writing too many costs less than a branch.
GRANULAR_TARGET inline void append(
  std::uint64_t bits, std::uint32_t base, std::uint16_t* to, int count) noexcept
{
  for (int done = 0; done < count; done += 8)
  {
    for (int i = 0; i < 8; ++i)
    {
      to[done + i] = static_cast<std::uint16_t>(base + _tzcnt_u64(bits));
      bits = _blsr_u64(bits);
    }
  }
}

GRANULAR_TARGET inline void append_edges(
  std::uint64_t bits, std::uint32_t base, Edges& edges) noexcept
{
  const int count = __builtin_popcountll(bits);
  append(bits, base, edges.offsets + edges.count, count);
  edges.count += static_cast<std::uint32_t>(count);
}

GRANULAR_TARGET inline void append_lines(
  std::uint64_t bits, std::uint32_t base, Edges& edges) noexcept
{
  std::uint16_t* const to = edges.line_ends + edges.lines;
  to[0] = static_cast<std::uint16_t>(base + _tzcnt_u64(bits));
  to[1] = static_cast<std::uint16_t>(base + _tzcnt_u64(_blsr_u64(bits)));
  const int count = __builtin_popcountll(bits);
  if (count > 2)
  {
    append(bits, base, to, count);
  }
  edges.lines += static_cast<std::uint32_t>(count);
}

/// No groups with this instruction set: all rows are left to be decoded one by one.
template <ColumnSink::Kind kind>
std::uint32_t decode_several(
  const char*, const Edges&, const Rows&, const ColumnSink&, std::uint32_t row) noexcept
{
  return row;
}

#include "granular/base/row_text_kernel.inc"
}

GRANULAR_TARGET RowResult decode(
  const char* first, const char* last, RowPlan& plan, std::int64_t max_rows) noexcept
{
  return decode_batches(first, last, plan, max_rows);
}
}
#endif
