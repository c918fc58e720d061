// SPDX-License-Identifier: BSD-3-Clause
#include "granular/text/row_text_detail.h"

#if GRANULAR_X86

#include "granular/text/row_text_tables.h"

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

/// Words that are parsed together.
constexpr std::uint32_t group = 4;

/// None need to be kept.
struct Constants
{
};

/// The bytes of a register by their place in its lanes of so many bytes.
template <std::size_t Bytes>
constexpr auto by_place(std::uint8_t from)
{
  std::array<std::uint8_t, 32> bytes{};
  for (std::size_t i = 0; i < 32; ++i)
  {
    bytes[i] = static_cast<std::uint8_t>(from + i % Bytes);
  }
  return bytes;
}

alignas(32) constexpr auto places_of_8 = by_place<8>(0);
alignas(32) constexpr auto places_of_16 = by_place<16>(0);
alignas(32) constexpr auto places_of_16_from_1 = by_place<16>(1);

template <class Table>
GRANULAR_TARGET inline __m256i load(const Table& table) noexcept
{
  return _mm256_load_si256(reinterpret_cast<const __m256i*>(table.data()));
}

/// Lengths of four words.
GRANULAR_TARGET inline __m128i lengths(const std::uint16_t* edges) noexcept
{
  const __m128i edge = _mm_loadu_si128(reinterpret_cast<const __m128i*>(edges));
  return _mm_sub_epi32(_mm_srli_epi32(edge, 16), _mm_and_si128(edge, _mm_set1_epi32(0xffff)));
}

GRANULAR_TARGET inline bool all_zero(__m256i bits) noexcept
{
  return _mm256_testz_si256(bits, bits) != 0;
}

/// Two of four words without their signs, each right-aligned in its lane.
struct TwoWords
{
  __m256i digits;
  __m256i marks; ///< in all bytes of a lane: the place of the point, from 1, and 128 for a minus
};

/// starts: where in their lanes the words start, in 32 bits each.
template <int which>
GRANULAR_TARGET inline TwoWords read_two(
  const char* base, const std::uint16_t* edges, __m256i starts) noexcept
{
  const auto word_at = [&](std::size_t i) GRANULAR_TARGET
  { return reinterpret_cast<const __m128i*>(base + edges[2 * i + 1] - 16); };
  const __m256i text =
    _mm256_inserti128_si256(_mm256_castsi128_si256(_mm_loadu_si128(word_at(which))),
      _mm_loadu_si128(word_at(which + 1)), 1);
  const __m256i start = _mm256_shuffle_epi8(
    starts, _mm256_set_m128i(_mm_set1_epi8(4 * which + 4), _mm_set1_epi8(4 * which)));
  const __m256i places = load(places_of_16);
  const __m256i word = _mm256_andnot_si256(
    _mm256_cmpgt_epi8(start, places), _mm256_sub_epi8(text, _mm256_set1_epi8('0')));
  const __m256i minus = _mm256_and_si256(
    _mm256_cmpeq_epi8(places, start), _mm256_cmpeq_epi8(text, _mm256_set1_epi8('-')));
  const __m256i point = _mm256_cmpeq_epi8(word, _mm256_set1_epi8('.' - '0'));
  const __m256i mark = _mm256_or_si256(_mm256_and_si256(minus, _mm256_set1_epi8(-128)),
    _mm256_and_si256(point, load(places_of_16_from_1)));
  __m256i sums = _mm256_sad_epu8(mark, _mm256_setzero_si256());
  sums = _mm256_add_epi64(sums, _mm256_shuffle_epi32(sums, 0x4e));
  const __m256i marks = _mm256_shuffle_epi8(sums, _mm256_setzero_si256());
  // bytes up to the point come from one place before; a second point would stay, and be found
  const __m256i shift = _mm256_min_epu8(
    _mm256_subs_epu8(_mm256_and_si256(marks, _mm256_set1_epi8(0x7f)), places), _mm256_set1_epi8(1));
  return { _mm256_shuffle_epi8(_mm256_andnot_si256(minus, word), _mm256_sub_epi8(places, shift)),
    sums };
}

/// Digits four by four as numbers: in the low half of each 32 bits.
GRANULAR_TARGET inline __m256i combine_fours(__m256i digits) noexcept
{
  const __m256i pairs = _mm256_maddubs_epi16(digits, _mm256_set1_epi16(0x010a));
  return _mm256_madd_epi16(pairs, _mm256_set1_epi32(0x00010064));
}

/// Whether some bytes are above 9.
GRANULAR_TARGET inline bool has_others(__m256i digits) noexcept
{
  return !all_zero(_mm256_subs_epu8(digits, _mm256_set1_epi8(9)));
}

/// Four doubles of a sign, digits and a point, of up to 16 characters. False if one is not.
GRANULAR_TARGET inline bool parse_doubles(
  const char* base, const std::uint16_t* edges, const Constants&, std::uint64_t* values) noexcept
{
  const __m128i length = lengths(edges);
  if (_mm_movemask_epi8(_mm_cmpgt_epi32(length, _mm_set1_epi32(16))) != 0)
  {
    return false;
  }
  const __m128i start = _mm_sub_epi32(_mm_set1_epi32(16), length);
  const __m256i starts = _mm256_broadcastsi128_si256(start);
  const TwoWords a = read_two<0>(base, edges, starts);
  const TwoWords b = read_two<2>(base, edges, starts);
  // from here on the words are in the order 0, 2, 1, 3
  const __m256i fours = _mm256_packus_epi32(combine_fours(a.digits), combine_fours(b.digits));
  const __m256i eights = _mm256_madd_epi16(fours, _mm256_set1_epi32(0x00012710));
  const __m256i number = _mm256_add_epi64(
    _mm256_mul_epu32(eights, _mm256_set1_epi64x(100'000'000)), _mm256_srli_epi64(eights, 32));
  const __m256i marks = _mm256_unpacklo_epi64(a.marks, b.marks);
  const __m256i point = _mm256_and_si256(marks, _mm256_set1_epi64x(0x7f));
  const __m256i no_point = _mm256_cmpeq_epi64(point, _mm256_setzero_si256());
  const __m256i behind =
    _mm256_andnot_si256(no_point, _mm256_sub_epi64(_mm256_set1_epi64x(16), point));
  const __m256i minus = _mm256_srli_epi64(marks, 7);
  // characters that are not digits
  const __m256i others = _mm256_add_epi64(_mm256_add_epi64(minus, no_point), _mm256_set1_epi64x(1));
  const __m256i ordered = _mm256_cvtepi32_epi64(_mm_shuffle_epi32(length, 0xd8));
  const __m256i enough = _mm256_cmpgt_epi64(ordered, others);
  const __m256i large = _mm256_srli_epi64(number, 53);
  if (has_others(_mm256_max_epu8(a.digits, b.digits)) || !all_zero(large) ||
    _mm256_movemask_epi8(enough) != -1)
  {
    return false;
  }
  // 2^84 + high * 2^32 and 2^52 + low as their bits, then without 2^84 and 2^52: both exact
  const __m256d high = _mm256_castsi256_pd(
    _mm256_or_si256(_mm256_srli_epi64(number, 32), _mm256_set1_epi64x(0x4530000000000000)));
  const __m256d low =
    _mm256_castsi256_pd(_mm256_blend_epi32(number, _mm256_set1_epi64x(0x4330000000000000), 0xaa));
  const __m256d whole = _mm256_add_pd(_mm256_sub_pd(high, _mm256_set1_pd(0x1p84 + 0x1p52)), low);
  const __m256d powers = _mm256_i64gather_pd(powers_of_ten.data(), behind, 8);
  const __m256d value =
    _mm256_or_pd(_mm256_div_pd(whole, powers), _mm256_castsi256_pd(_mm256_slli_epi64(minus, 63)));
  _mm256_storeu_pd(reinterpret_cast<double*>(values), _mm256_permute4x64_pd(value, 0xd8));
  return true;
}

/// Eight digits of each of four integers.
struct EightDigits
{
  __m256i value;
  __m256i minus; ///< a byte of ones at its place
  __m256i digits;
};

/// The eight bytes that are so many before the ends. start: place of the first that counts, perhaps
/// before these bytes or behind them.
GRANULAR_TARGET inline EightDigits read_digits(
  const char* base, const std::uint16_t* edges, std::ptrdiff_t before, __m128i start) noexcept
{
  const auto text = [&](int i) GRANULAR_TARGET
  {
    long long bytes;
    std::memcpy(&bytes, base + edges[2 * i + 1] - before, 8);
    return bytes;
  };
  const __m256i word = _mm256_setr_epi64x(text(0), text(1), text(2), text(3));
  const __m256i places = load(places_of_8);
  const __m256i starts = _mm256_shuffle_epi8(
    _mm256_cvtepu32_epi64(start), _mm256_setr_epi64x(0, 0x0808080808080808, 0, 0x0808080808080808));
  const __m256i minus = _mm256_and_si256(
    _mm256_cmpeq_epi8(places, starts), _mm256_cmpeq_epi8(word, _mm256_set1_epi8('-')));
  const __m256i outside = _mm256_or_si256(_mm256_cmpgt_epi8(starts, places), minus);
  const __m256i digits = _mm256_andnot_si256(outside, _mm256_sub_epi8(word, _mm256_set1_epi8('0')));
  const __m256i eights =
    _mm256_madd_epi16(combine_fours(digits), _mm256_set1_epi64x(0x0000000100002710));
  return { _mm256_add_epi64(_mm256_and_si256(eights, _mm256_set1_epi64x(0xffffffff)),
             _mm256_srli_epi64(eights, 32)),
    minus, digits };
}

/// Four integers of a sign and digits, of up to 16 characters. False if one is not.
GRANULAR_TARGET inline bool parse_integers(
  const char* base, const std::uint16_t* edges, const Constants&, std::uint64_t* values) noexcept
{
  const __m128i length = lengths(edges);
  EightDigits low = read_digits(base, edges, 8, _mm_sub_epi32(_mm_set1_epi32(8), length));
  bool good = true;
  if (_mm_movemask_epi8(_mm_cmpgt_epi32(length, _mm_set1_epi32(8))) != 0)
  {
    const EightDigits high =
      read_digits(base, edges, 16, _mm_sub_epi32(_mm_set1_epi32(16), length));
    low.value =
      _mm256_add_epi64(low.value, _mm256_mul_epu32(high.value, _mm256_set1_epi64x(100'000'000)));
    low.minus = _mm256_or_si256(low.minus, high.minus);
    low.digits = _mm256_max_epu8(low.digits, high.digits);
    good = _mm_movemask_epi8(_mm_cmpgt_epi32(length, _mm_set1_epi32(16))) == 0;
  }
  // all ones where there is no sign
  const __m256i positive = _mm256_cmpeq_epi64(low.minus, _mm256_setzero_si256());
  const __m256i single = _mm256_cmpeq_epi64(_mm256_cvtepi32_epi64(length), _mm256_set1_epi64x(1));
  const __m256i sign = _mm256_andnot_si256(positive, _mm256_set1_epi64x(-1));
  const __m256i value = _mm256_sub_epi64(_mm256_xor_si256(low.value, sign), sign);
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(values), value);
  return good && !has_others(low.digits) && all_zero(_mm256_and_si256(single, sign));
}

#include "granular/text/row_text_avx2_word.inc"
#include "granular/text/row_text_kernel.inc"
}

GRANULAR_TARGET RowResult decode(
  const char* first, const char* last, RowPlan& plan, std::int64_t max_rows) noexcept
{
  return decode_batches(first, last, plan, max_rows);
}
}
#endif
