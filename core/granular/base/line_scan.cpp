// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/line_scan.h"

#include <bit>
#include <cstring>

#if defined(__x86_64__) && defined(__GNUC__)
#define GRANULAR_X86 1
#include <immintrin.h>
#endif

namespace granular
{
namespace
{
LineScan scan_portable(
  const char* first, const char* last, char mark, bool at_line_start) noexcept
{
  LineScan scan{ first };
  while (scan.ptr < last && !(at_line_start && *scan.ptr == mark))
  {
    const void* const feed =
      std::memchr(scan.ptr, '\n', static_cast<std::size_t>(last - scan.ptr));
    if (!feed)
    {
      scan.ptr = last;
      break;
    }
    scan.ptr = static_cast<const char*>(feed) + 1;
    scan.after_last_feed = scan.ptr;
    ++scan.feeds;
    at_line_start = true;
  }
  return scan;
}

#if GRANULAR_X86
/// Bit i: byte i of the block is c.
__attribute__((target("avx2"))) inline std::uint64_t find_byte(const char* block, __m256i c) noexcept
{
  const __m256i low = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(block));
  const __m256i high = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(block + 32));
  const auto low_bits = static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(low, c)));
  const auto high_bits =
    static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(high, c)));
  return std::uint64_t{ high_bits } << 32 | low_bits;
}

__attribute__((target("avx2,bmi,popcnt"))) LineScan scan_avx2(
  const char* first, const char* last, char mark, bool at_line_start) noexcept
{
  const __m256i feed = _mm256_set1_epi8('\n');
  const __m256i marks = _mm256_set1_epi8(mark);
  std::uint64_t carry = at_line_start ? 1 : 0;
  LineScan scan{ last };
  for (const char* block = first; block < last; block += 64)
  {
    std::uint64_t feeds = find_byte(block, feed);
    std::uint64_t found = (feeds << 1 | carry) & find_byte(block, marks);
    if (last - block < 64)
    {
      const std::uint64_t inside = (std::uint64_t{ 1 } << (last - block)) - 1;
      feeds &= inside;
      found &= inside;
    }
    carry = feeds >> 63;
    if (found != 0)
    {
      scan.ptr = block + std::countr_zero(found);
      feeds &= (found & (0 - found)) - 1;
    }
    if (feeds != 0)
    {
      scan.feeds += std::popcount(feeds);
      scan.after_last_feed = block + 64 - std::countl_zero(feeds);
    }
    if (found != 0)
    {
      break;
    }
  }
  return scan;
}
#endif
}

LineScan scan_lines(
  const char* first, const char* last, char mark, bool at_line_start, Simd simd) noexcept
{
#if GRANULAR_X86
  if (simd != Simd::Portable)
  {
    return scan_avx2(first, last, mark, at_line_start);
  }
#endif
  return scan_portable(first, last, mark, at_line_start);
}
}
