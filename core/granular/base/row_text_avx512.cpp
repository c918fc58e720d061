// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/row_text_detail.h"

#if GRANULAR_X86

// GCC 12 takes the deliberately undefined operands inside its own intrinsics for a mistake of the
// caller (GCC bug 105593).
#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "granular/base/row_text_tables.h"

#include <immintrin.h>

namespace granular::row_text::avx512
{
namespace
{
#define GRANULAR_TARGET                                                                     \
  __attribute__((target("avx2,bmi,bmi2,popcnt,avx512f,avx512bw,avx512vl,avx512dq,avx512cd," \
                        "avx512vbmi2")))

GRANULAR_TARGET inline BlockMarks mark_block(const char* block) noexcept
{
  const __m512i bytes = _mm512_loadu_si512(block);
  return { _mm512_cmpgt_epu8_mask(bytes, _mm512_set1_epi8(' ')),
    _mm512_cmpeq_epi8_mask(bytes, _mm512_set1_epi8('\n')) };
}

GRANULAR_TARGET inline void append(
  std::uint64_t bits, std::uint32_t base, std::uint16_t* to) noexcept
{
  alignas(64) static constexpr auto places = []
  {
    std::array<std::uint8_t, 64> bytes{};
    for (std::size_t i = 0; i < 64; ++i)
    {
      bytes[i] = static_cast<std::uint8_t>(i);
    }
    return bytes;
  }();
  const __m512i packed = _mm512_maskz_compress_epi8(bits, _mm512_load_si512(places.data()));
  const __m512i offset = _mm512_set1_epi16(static_cast<short>(base));
  const __m512i low = _mm512_cvtepu8_epi16(_mm512_maskz_extracti64x4_epi64(0xff, packed, 0));
  _mm512_storeu_si512(to, _mm512_add_epi16(low, offset));
  if (__builtin_popcountll(bits) > 32)
  {
    const __m512i high = _mm512_cvtepu8_epi16(_mm512_maskz_extracti64x4_epi64(0xff, packed, 1));
    _mm512_storeu_si512(to + 32, _mm512_add_epi16(high, offset));
  }
}

GRANULAR_TARGET inline void append_edges(
  std::uint64_t bits, std::uint32_t base, Edges& edges) noexcept
{
  append(bits, base, edges.offsets + edges.count);
  edges.count += static_cast<std::uint32_t>(__builtin_popcountll(bits));
}

GRANULAR_TARGET inline void append_lines(
  std::uint64_t bits, std::uint32_t base, Edges& edges) noexcept
{
  append(bits, base, edges.line_ends + edges.lines);
  edges.lines += static_cast<std::uint32_t>(__builtin_popcountll(bits));
}

/// 0 to 15 in each of four lanes.
GRANULAR_TARGET inline __m512i byte_places() noexcept
{
  return _mm512_broadcast_i32x4(
    _mm_setr_epi8(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
}

/// Byte 0 of number j in all bytes of lane j.
GRANULAR_TARGET inline __m512i spread(__m128i numbers) noexcept
{
  const __m512i lane = _mm512_set_epi64(0x0c0c0c0c0c0c0c0c, 0x0c0c0c0c0c0c0c0c, 0x0808080808080808,
    0x0808080808080808, 0x0404040404040404, 0x0404040404040404, 0, 0);
  return _mm512_shuffle_epi8(_mm512_broadcast_i32x4(numbers), lane);
}

/// The sixteen mask bits of each lane as a number.
GRANULAR_TARGET inline __m128i lane_bits(__mmask64 mask) noexcept
{
  return _mm_cvtepu16_epi32(_mm_cvtsi64_si128(static_cast<long long>(mask)));
}

/// combine_digits of four words.
GRANULAR_TARGET inline __m256i combine_four(__m512i digits) noexcept
{
  const __m512i pairs = _mm512_maddubs_epi16(digits, _mm512_set1_epi16(0x010a));
  const __m512i fours = _mm512_madd_epi16(pairs, _mm512_set1_epi32(0x00010064));
  const __m512i packed = _mm512_packus_epi32(fours, fours);
  const __m512i eights = _mm512_madd_epi16(packed, _mm512_set1_epi32(0x00012710));
  const __m512i order = _mm512_setr_epi64(0, 2, 4, 6, 0, 0, 0, 0);
  const __m256i both =
    _mm512_maskz_extracti64x4_epi64(0xff, _mm512_permutexvar_epi64(order, eights), 0);
  return _mm256_add_epi64(
    _mm256_mul_epu32(both, _mm256_set1_epi64x(100'000'000)), _mm256_srli_epi64(both, 32));
}

/// Whether values stay what they are as Stored.
template <typename Stored, typename Parsed>
bool holds(const std::array<Parsed, 4>& values) noexcept
{
  return std::all_of(values.begin(), values.end(),
    [](Parsed value) { return static_cast<Parsed>(static_cast<Stored>(value)) == value; });
}

/// Offsets of four words: of the first byte and, in the upper half, of the byte behind the last.
using FourEdges = std::array<std::uint32_t, 4>;

/// Four words, each right-aligned in its lane.
struct FourWords
{
  __m512i bytes;
  __m128i length;   ///< at most 16, or fits is false
  __mmask64 minus;  ///< the signs
  __mmask64 inside; ///< the bytes behind the signs
  bool fits;

  GRANULAR_TARGET __mmask8 negative() const noexcept { return lanes(minus); }

  /// The lanes that have any bit.
  GRANULAR_TARGET static __mmask8 lanes(__mmask64 mask) noexcept
  {
    return _mm_cmpneq_epi32_mask(lane_bits(mask), _mm_setzero_si128());
  }
};

GRANULAR_TARGET inline __m128i load_lane(const char* base, std::uint32_t edge) noexcept
{
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(base + (edge >> 16) - 16));
}

GRANULAR_TARGET inline FourWords load_four(const char* base, const FourEdges& edges) noexcept
{
  FourWords words;
  // put together in registers: a load across four stores would wait for all of them
  const __m128i edge = _mm_setr_epi32(static_cast<int>(edges[0]), static_cast<int>(edges[1]),
    static_cast<int>(edges[2]), static_cast<int>(edges[3]));
  words.length =
    _mm_sub_epi32(_mm_srli_epi32(edge, 16), _mm_and_si128(edge, _mm_set1_epi32(0xffff)));
  words.fits = _mm_cmpgt_epi32_mask(words.length, _mm_set1_epi32(16)) == 0;
  words.bytes = _mm512_zextsi128_si512(load_lane(base, edges[0]));
  words.bytes = _mm512_inserti32x4(words.bytes, load_lane(base, edges[1]), 1);
  words.bytes = _mm512_inserti32x4(words.bytes, load_lane(base, edges[2]), 2);
  words.bytes = _mm512_inserti32x4(words.bytes, load_lane(base, edges[3]), 3);
  const __m512i start = spread(_mm_sub_epi32(_mm_set1_epi32(16), words.length));
  words.minus = _mm512_mask_cmpeq_epi8_mask(
    _mm512_cmpeq_epi8_mask(byte_places(), start), words.bytes, _mm512_set1_epi8('-'));
  words.inside = _mm512_cmpge_epu8_mask(byte_places(), start) & ~words.minus;
  return words;
}

/// What is taken out of the digits while they are put together.
struct FourScales
{
  __m128i power;   ///< of ten
  __m128i removed; ///< bytes that are no digits: exponents and points
  bool good;
};

/// Exponents "e-05" in the last four bytes of the lanes in letters. Moves the digits up over them.
GRANULAR_TARGET inline FourScales take_exponents(
  const FourWords& words, __mmask64 letters, __m512i& digits) noexcept
{
  const __m512i shift = _mm512_and_si512(
    _mm512_shuffle_epi8(_mm512_movm_epi8(letters), _mm512_set1_epi8(12)), _mm512_set1_epi8(4));
  digits = _mm512_shuffle_epi8(digits, _mm512_sub_epi8(byte_places(), shift));

  const __m512i order = _mm512_setr_epi32(3, 7, 11, 15, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);
  const __m128i field =
    _mm512_maskz_extracti32x4_epi32(0xf, _mm512_permutexvar_epi32(order, words.bytes), 0);
  const __mmask8 has = FourWords::lanes(letters);
  const __m128i low = _mm_set1_epi32(0xff);
  const __m128i zero_digit = _mm_set1_epi32('0');
  const __m128i tens = _mm_sub_epi32(_mm_and_si128(_mm_srli_epi32(field, 16), low), zero_digit);
  const __m128i ones = _mm_sub_epi32(_mm_srli_epi32(field, 24), zero_digit);
  const __m128i sign = _mm_and_si128(_mm_srli_epi32(field, 8), low);
  const __mmask8 negative = _mm_cmpeq_epi32_mask(sign, _mm_set1_epi32('-'));
  const __mmask8 positive = _mm_cmpeq_epi32_mask(sign, _mm_set1_epi32('+'));
  const __mmask8 right = static_cast<__mmask8>(_mm_cmple_epu32_mask(tens, _mm_set1_epi32(9)) &
    _mm_cmple_epu32_mask(ones, _mm_set1_epi32(9)) & (negative | positive));

  FourScales scales;
  scales.power = _mm_add_epi32(_mm_mullo_epi32(tens, _mm_set1_epi32(10)), ones);
  scales.power = _mm_mask_sub_epi32(scales.power, negative, _mm_setzero_si128(), scales.power);
  scales.power = _mm_maskz_mov_epi32(has, scales.power);
  scales.removed = _mm_maskz_set1_epi32(has, 4);
  scales.good = (has & ~right) == 0;
  return scales;
}

/// Moves the digits before the points up over them.
GRANULAR_TARGET inline void take_points(FourScales& scales, __m512i& digits) noexcept
{
  const __m128i bits = lane_bits(_mm512_cmpeq_epi8_mask(digits, _mm512_set1_epi8('.' - '0')));
  const __m128i leading = _mm_lzcnt_epi32(bits); // 16 + digits behind the point; 32: no point
  const __mmask8 has = _mm_cmpneq_epi32_mask(bits, _mm_setzero_si128());
  const __m512i place = spread(_mm_sub_epi32(_mm_set1_epi32(31), leading)); // -1: no point
  const __mmask64 before = _mm512_cmple_epi8_mask(byte_places(), place);
  digits = _mm512_shuffle_epi8(
    digits, _mm512_mask_sub_epi8(byte_places(), before, byte_places(), _mm512_set1_epi8(1)));
  const __m128i behind = _mm_maskz_sub_epi32(has, leading, _mm_set1_epi32(16));
  scales.power = _mm_sub_epi32(scales.power, behind);
  scales.removed = _mm_mask_add_epi32(scales.removed, has, scales.removed, _mm_set1_epi32(1));
}

/// Whether only digits are left, and in each lane at least one.
GRANULAR_TARGET inline bool are_numbers(
  const FourWords& words, __m128i removed, __m512i digits) noexcept
{
  const __m128i other = _mm_mask_add_epi32(removed, words.negative(), removed, _mm_set1_epi32(1));
  return _mm_cmple_epi32_mask(words.length, other) == 0 &&
    _mm512_cmpgt_epu8_mask(digits, _mm512_set1_epi8(9)) == 0;
}

/// Numbers of which some take more than one rounding of exact operands.
GRANULAR_TARGET bool scale_one_by_one(
  __m256i digits, __m128i power, std::array<double, 4>& values) noexcept
{
  std::array<std::uint64_t, 4> mantissas;
  std::array<int, 4> powers;
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(mantissas.data()), digits);
  _mm_storeu_si128(reinterpret_cast<__m128i*>(powers.data()), power);
  bool good = true;
  for (std::size_t i = 0; i < 4; ++i)
  {
    good = scale(mantissas[i], powers[i], values[i]) && good;
  }
  return good;
}

/// digits * 10^power with the signs of negative.
GRANULAR_TARGET inline bool scale_four(
  __m256i digits, __m128i power, __mmask8 negative, std::array<double, 4>& values) noexcept
{
  const __m128i zero = _mm_setzero_si128();
  const bool exact = _mm_cmpgt_epi32_mask(_mm_abs_epi32(power), _mm_set1_epi32(22)) == 0 &&
    _mm256_cmpge_epu64_mask(digits, _mm256_set1_epi64x(std::int64_t{ 1 } << 53)) == 0;
  __m256d value;
  if (exact)
  {
    const __m128i up = _mm_max_epi32(power, zero);
    const __m128i down = _mm_sub_epi32(zero, _mm_min_epi32(power, zero));
    value = _mm256_cvtepu64_pd(digits);
    if (_mm_test_epi32_mask(up, up) != 0)
    {
      value = _mm256_mul_pd(value, _mm256_i32gather_pd(powers_of_ten.data(), up, 8));
    }
    value = _mm256_div_pd(value, _mm256_i32gather_pd(powers_of_ten.data(), down, 8));
  }
  else
  {
    if (!scale_one_by_one(digits, power, values))
    {
      return false;
    }
    value = _mm256_loadu_pd(values.data());
  }
  value = _mm256_mask_xor_pd(value, negative, value, _mm256_set1_pd(-0.0));
  _mm256_storeu_pd(values.data(), value);
  return true;
}

/// parse_common_double of four words at once. False if any of them is not common.
GRANULAR_TARGET inline bool parse_four(
  const char* base, const FourEdges& edges, std::array<double, 4>& values) noexcept
{
  const FourWords words = load_four(base, edges);
  if (!words.fits)
  {
    return false;
  }
  __m512i digits = _mm512_maskz_sub_epi8(words.inside, words.bytes, _mm512_set1_epi8('0'));
  const __mmask64 letters = words.inside & 0x1000100010001000 &
    _mm512_cmpeq_epi8_mask(
      _mm512_or_si512(words.bytes, _mm512_set1_epi8(0x20)), _mm512_set1_epi8('e'));
  FourScales scales = { _mm_setzero_si128(), _mm_setzero_si128(), true };
  if (letters != 0)
  {
    scales = take_exponents(words, letters, digits);
  }
  take_points(scales, digits);
  if (!scales.good || !are_numbers(words, scales.removed, digits))
  {
    return false;
  }
  return scale_four(combine_four(digits), scales.power, words.negative(), values);
}

/// parse_common_integer of four words at once. False if any of them is not common.
GRANULAR_TARGET inline bool parse_four(
  const char* base, const FourEdges& edges, std::array<std::int64_t, 4>& values) noexcept
{
  const FourWords words = load_four(base, edges);
  if (!words.fits)
  {
    return false;
  }
  const __m512i digits = _mm512_maskz_sub_epi8(words.inside, words.bytes, _mm512_set1_epi8('0'));
  if (!are_numbers(words, _mm_setzero_si128(), digits))
  {
    return false;
  }
  __m256i value = combine_four(digits);
  value = _mm256_mask_sub_epi64(value, words.negative(), _mm256_setzero_si256(), value);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(values.data()), value);
  return true;
}

/// Decodes groups of four rows as long as they are common, from row on. Returns where it stopped.
template <typename Parsed, typename Stored>
GRANULAR_TARGET inline std::uint32_t decode_groups(const char* base, const Edges& edges,
  const Rows& rows, const ColumnSink& sink, std::uint32_t row) noexcept
{
  const std::uint16_t* const offsets = edges.offsets + 2 * sink.column;
  char* data = sink.data + sink.stride * static_cast<std::ptrdiff_t>(row);
  for (; row + 4 <= rows.count; row += 4)
  {
    FourEdges group;
    for (std::size_t i = 0; i < 4; ++i)
    {
      std::memcpy(&group[i], offsets + rows.first_edges[row + i], sizeof group[i]);
    }
    std::array<Parsed, 4> values;
    if (!parse_four(base, group, values) || !holds<Stored>(values))
    {
      break;
    }
    for (const Parsed parsed : values)
    {
      const auto value = static_cast<Stored>(parsed);
      std::memcpy(data, &value, sizeof value);
      data += sink.stride;
    }
  }
  return row;
}

template <ColumnSink::Kind kind>
GRANULAR_TARGET inline std::uint32_t decode_several(const char* base, const Edges& edges,
  const Rows& rows, const ColumnSink& sink, std::uint32_t row) noexcept
{
  switch (kind)
  {
    case ColumnSink::Kind::Float64:
      return decode_groups<double, double>(base, edges, rows, sink, row);
    case ColumnSink::Kind::Int64:
      return decode_groups<std::int64_t, std::int64_t>(base, edges, rows, sink, row);
    case ColumnSink::Kind::Int32:
      return decode_groups<std::int64_t, std::int32_t>(base, edges, rows, sink, row);
    case ColumnSink::Kind::Text:
      break;
  }
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
