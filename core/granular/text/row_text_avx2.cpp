// SPDX-License-Identifier: BSD-3-Clause
#include "granular/text/row_text_detail.h"

#if GRANULAR_X86

#include "granular/common/intrinsics.h"
#include "granular/text/row_text_tables.h"

#include <utility>

namespace granular::row_text::avx2
{
namespace
{
#define GRANULAR_TARGET __attribute__((target("avx2,bmi,bmi2,fma,popcnt")))

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

/// Byte by byte: a table takes less time than to look for each bit.
GRANULAR_TARGET inline void append_edges(
  std::uint64_t bits, std::uint32_t base, Edges& edges) noexcept
{
  std::uint16_t* to = edges.offsets + edges.count;
  edges.count += static_cast<std::uint32_t>(__builtin_popcountll(bits));
  __m128i offset = _mm_set1_epi16(static_cast<short>(base));
  for (int i = 0; i < 8; ++i)
  {
    const std::uint64_t byte = bits & 0xff;
    bits >>= 8;
    const __m128i places =
      _mm_loadl_epi64(reinterpret_cast<const __m128i*>(bit_places[byte].data()));
    _mm_storeu_si128(
      reinterpret_cast<__m128i*>(to), _mm_add_epi16(_mm_cvtepu8_epi16(places), offset));
    to += __builtin_popcountll(byte);
    offset = _mm_add_epi16(offset, _mm_set1_epi16(8));
  }
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

/// A constant that is kept in a register, or in memory: it is not made anew each time.
GRANULAR_TARGET inline __m256i kept(__m256i constant) noexcept
{
  asm("" : "+x"(constant));
  return constant;
}

/// Constants for all words.
struct Constants
{
  __m256i zero;
  __m256i minus;
  __m256i point;
  __m256i one;
  __m256i sign_bit;
  __m256i all_but_sign;
  __m256i nine;
  __m256i pairs;  ///< to combine digits
  __m256i fours;  ///< pairs of them
  __m256i eights; ///< fours of them
  __m256i hundred_million;
  __m256i point_bits;
  __m256i one_64;
  __m256i sixteen_64;
  __m256i high_bits; ///< of 2^84
  __m256i low_bits;  ///< of 2^52
  __m256i both;      ///< 2^84 + 2^52

  GRANULAR_TARGET Constants() noexcept
    : zero(kept(_mm256_set1_epi8('0')))
    , minus(kept(_mm256_set1_epi8('-')))
    , point(kept(_mm256_set1_epi8('.' - '0')))
    , one(kept(_mm256_set1_epi8(1)))
    , sign_bit(kept(_mm256_set1_epi8(-128)))
    , all_but_sign(kept(_mm256_set1_epi8(0x7f)))
    , nine(kept(_mm256_set1_epi8(9)))
    , pairs(kept(_mm256_set1_epi16(0x010a)))
    , fours(kept(_mm256_set1_epi32(0x00010064)))
    , eights(kept(_mm256_set1_epi32(0x00012710)))
    , hundred_million(kept(_mm256_set1_epi64x(100'000'000)))
    , point_bits(kept(_mm256_set1_epi64x(0x7f)))
    , one_64(kept(_mm256_set1_epi64x(1)))
    , sixteen_64(kept(_mm256_set1_epi64x(16)))
    , high_bits(kept(_mm256_set1_epi64x(0x4530000000000000)))
    , low_bits(kept(_mm256_set1_epi64x(0x4330000000000000)))
    , both(kept(_mm256_castpd_si256(_mm256_set1_pd(0x1p84 + 0x1p52))))
  {
  }
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

/// The bytes of a register by their place in its lanes: those that are named, else 0.
template <std::size_t Bytes, std::size_t Count>
constexpr auto by_place_of(const std::pair<std::size_t, std::uint8_t> (&named)[Count])
{
  std::array<std::uint8_t, 32> bytes{};
  for (std::size_t lane = 0; lane < 32; lane += Bytes)
  {
    for (const auto& [place, byte] : named)
    {
      bytes[lane + place] = byte;
    }
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

/// Digits four by four as numbers: in the low half of each 32 bits.
GRANULAR_TARGET inline __m256i combine_fours(__m256i digits, const Constants& constants) noexcept
{
  return _mm256_madd_epi16(_mm256_maddubs_epi16(digits, constants.pairs), constants.fours);
}

/// Returns true if some bytes are above 9.
GRANULAR_TARGET inline bool has_others(__m256i digits, const Constants& constants) noexcept
{
  return !all_zero(_mm256_subs_epu8(digits, constants.nine));
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
GRANULAR_TARGET inline EightDigits read_digits(const char* base, const std::uint16_t* edges,
  std::ptrdiff_t before, __m128i start, const Constants& constants) noexcept
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
  const __m256i minus =
    _mm256_and_si256(_mm256_cmpeq_epi8(places, starts), _mm256_cmpeq_epi8(word, constants.minus));
  const __m256i outside = _mm256_or_si256(_mm256_cmpgt_epi8(starts, places), minus);
  const __m256i digits = _mm256_andnot_si256(outside, _mm256_sub_epi8(word, constants.zero));
  const __m256i eights =
    _mm256_madd_epi16(combine_fours(digits, constants), _mm256_set1_epi64x(0x0000000100002710));
  return { _mm256_add_epi64(_mm256_and_si256(eights, _mm256_set1_epi64x(0xffffffff)),
             _mm256_srli_epi64(eights, 32)),
    minus, digits };
}

/// Four integers of a sign and digits, of up to 16 characters. False if one is not.
GRANULAR_TARGET inline bool parse_integers(const char* base, const std::uint16_t* edges,
  const Constants& constants, std::uint64_t* values) noexcept
{
  const __m128i length = lengths(edges);
  EightDigits low =
    read_digits(base, edges, 8, _mm_sub_epi32(_mm_set1_epi32(8), length), constants);
  bool good = true;
  if (_mm_movemask_epi8(_mm_cmpgt_epi32(length, _mm_set1_epi32(8))) != 0)
  {
    const EightDigits high =
      read_digits(base, edges, 16, _mm_sub_epi32(_mm_set1_epi32(16), length), constants);
    low.value =
      _mm256_add_epi64(low.value, _mm256_mul_epu32(high.value, constants.hundred_million));
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
  return good && !has_others(low.digits, constants) && all_zero(_mm256_and_si256(single, sign));
}

#include "granular/text/row_text_avx2_word.inc"

#include "granular/text/row_text_word.inc"

#include "granular/text/row_text_avx2_doubles.inc"

#include "granular/text/row_text_kernel.inc"
}

GRANULAR_TARGET RowResult decode(
  const char* first, const char* last, RowPlan& plan, std::int64_t max_rows) noexcept
{
  return decode_batches(first, last, plan, max_rows);
}
}
#endif
