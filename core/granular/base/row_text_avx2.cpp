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

/// A word of up to 16 digits, right-aligned, as a number. digits: values 0 to 9, zeros in front.
GRANULAR_TARGET inline std::uint64_t combine_digits(__m128i digits) noexcept
{
  const __m128i pairs = _mm_maddubs_epi16(
    digits, _mm_setr_epi8(10, 1, 10, 1, 10, 1, 10, 1, 10, 1, 10, 1, 10, 1, 10, 1));
  const __m128i fours = _mm_madd_epi16(pairs, _mm_setr_epi16(100, 1, 100, 1, 100, 1, 100, 1));
  const __m128i packed = _mm_packus_epi32(fours, fours);
  const __m128i eights =
    _mm_madd_epi16(packed, _mm_setr_epi16(10000, 1, 10000, 1, 10000, 1, 10000, 1));
  const auto both = static_cast<std::uint64_t>(_mm_cvtsi128_si64(eights));
  return (both & 0xffffffffu) * 100'000'000u + (both >> 32);
}

/// The last count bytes before end, minus '0', right-aligned behind zeros. 0 <= count <= 16.
GRANULAR_TARGET inline __m128i load_word(const char* end, std::size_t count) noexcept
{
  const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i*>(end - 16));
  const __m128i keep = _mm_loadu_si128(reinterpret_cast<const __m128i*>(&keep_last[16 + count]));
  return _mm_and_si128(_mm_sub_epi8(bytes, _mm_set1_epi8('0')), keep);
}

GRANULAR_TARGET inline bool all_digits(__m128i digits) noexcept
{
  // unsigned saturation: 118 + 10 is the first to set the sign bit
  return _mm_movemask_epi8(_mm_adds_epu8(digits, _mm_set1_epi8(118))) == 0;
}

/// An exponent "e+05" of two digits, which is the last four bytes before last.
GRANULAR_TARGET inline bool parse_exponent(const char* last, int& power) noexcept
{
  const unsigned tens = static_cast<unsigned char>(last[-2]) - unsigned{ '0' };
  const unsigned ones = static_cast<unsigned char>(last[-1]) - unsigned{ '0' };
  const char sign = last[-3];
  const int magnitude = static_cast<int>(tens * 10 + ones);
  power = sign == '-' ? -magnitude : magnitude;
  return (tens <= 9) & (ones <= 9) & ((sign == '-') | (sign == '+'));
}

/// Up to 16 digits and a point before end, as digits and how many of them are behind the point.
GRANULAR_TARGET inline bool parse_short(
  const char* end, std::size_t count, std::uint64_t& value, int& behind) noexcept
{
  __m128i digits = load_word(end, count);
  const auto points =
    static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_cmpeq_epi8(digits, _mm_set1_epi8('.' - '0'))));
  const auto point = static_cast<std::size_t>(__builtin_ctz(points | 0x10000u)); // 16: none
  digits = _mm_shuffle_epi8(
    digits, _mm_load_si128(reinterpret_cast<const __m128i*>(drop_point[point].data())));
  value = combine_digits(digits);
  behind = digits_behind[point];
  return all_digits(digits) & ((point == 16) | (count > 1));
}

/// The same for 17 to 32 bytes, of which at most 19 are digits.
GRANULAR_TARGET inline bool parse_long(
  const char* end, std::size_t count, std::uint64_t& value, int& behind) noexcept
{
  const __m256i zero = _mm256_set1_epi8('0');
  const __m256i keep = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(&keep_last[count]));
  __m256i bytes = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(end - 32));
  bytes = _mm256_and_si256(_mm256_sub_epi8(bytes, zero), keep);
  const auto points = static_cast<std::uint32_t>(
    _mm256_movemask_epi8(_mm256_cmpeq_epi8(bytes, _mm256_set1_epi8('.' - '0'))));
  behind = 0;
  std::size_t digit_count = count;
  if (points != 0)
  {
    // bytes up to the point come from one place further on
    behind = __builtin_clz(points);
    --digit_count;
    const __m256i before = _mm256_loadu_si256(
      reinterpret_cast<const __m256i*>(&keep_last[static_cast<std::size_t>(behind)]));
    const __m256i shifted =
      _mm256_sub_epi8(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(end - 33)), zero);
    bytes = _mm256_blendv_epi8(shifted, bytes, before);
    bytes = _mm256_and_si256(
      bytes, _mm256_loadu_si256(reinterpret_cast<const __m256i*>(&keep_last[digit_count])));
  }
  const __m128i high = _mm256_castsi256_si128(bytes);
  const __m128i low = _mm256_extracti128_si256(bytes, 1);
  value = combine_digits(high) * 10'000'000'000'000'000u + combine_digits(low);
  return digit_count <= 19 && all_digits(_mm_max_epu8(high, low));
}

/// The common cases of parse_double: a sign, up to 19 digits and a point, a two-digit exponent.
/// False for anything else, which is then parse_double's.
GRANULAR_TARGET inline bool parse_common_double(
  const char* first, const char* last, double& value) noexcept
{
  const bool negative = *first == '-';
  const char* const start = first + negative;
  const char* end = last;
  int power = 0;
  if ((last[-4] | 0x20) == 'e' && last - start > 4)
  {
    if (!parse_exponent(last, power))
    {
      return false;
    }
    end = last - 4;
  }
  const auto count = static_cast<std::size_t>(end - start);
  std::uint64_t digits;
  int behind;
  if (count - 1 < 16)
  {
    if (!parse_short(end, count, digits, behind))
    {
      return false;
    }
  }
  else if (count - 1 >= 32 || !parse_long(end, count, digits, behind))
  {
    return false;
  }
  double magnitude;
  if (!to_double(digits, power - behind, magnitude))
  {
    return false;
  }
  value = std::bit_cast<double>(
    std::bit_cast<std::uint64_t>(magnitude) | std::uint64_t{ negative } << 63);
  return true;
}

/// The common case of parse_int64: a minus sign and up to 16 digits.
GRANULAR_TARGET inline bool parse_common_integer(
  const char* first, const char* last, std::int64_t& value) noexcept
{
  const bool negative = *first == '-';
  const auto count = static_cast<std::size_t>(last - first - negative);
  if (count - 1 >= 16)
  {
    return false;
  }
  const __m128i digits = load_word(last, count);
  if (!all_digits(digits))
  {
    return false;
  }
  const auto magnitude = static_cast<std::int64_t>(combine_digits(digits));
  value = negative ? -magnitude : magnitude;
  return true;
}

GRANULAR_TARGET inline bool parse_doubles(const char* base, Words& words) noexcept
{
  for (std::uint32_t i = 0; i < words.count; ++i)
  {
    const char* const first = base + words.edges[2 * i];
    const char* const last = base + words.edges[2 * i + 1];
    double value;
    if (!parse_common_double(first, last, value) && !parse_double(first, last, value))
    {
      return false;
    }
    words.values[i] = std::bit_cast<std::uint64_t>(value);
  }
  return true;
}

GRANULAR_TARGET inline bool parse_integers(const char* base, Words& words) noexcept
{
  for (std::uint32_t i = 0; i < words.count; ++i)
  {
    const char* const first = base + words.edges[2 * i];
    const char* const last = base + words.edges[2 * i + 1];
    std::int64_t value;
    if (!parse_common_integer(first, last, value) && !parse_int64(first, last, value))
    {
      return false;
    }
    words.values[i] = std::bit_cast<std::uint64_t>(value);
  }
  return true;
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
