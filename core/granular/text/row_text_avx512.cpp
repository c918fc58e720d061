// SPDX-License-Identifier: BSD-3-Clause
#include "granular/text/row_text_detail.h"

#if GRANULAR_X86

#include "granular/common/intrinsics.h"
#include "granular/text/row_text_tables.h"

namespace granular::row_text::avx512
{
namespace
{
#define GRANULAR_TARGET                                                                \
  __attribute__((target("avx2,bmi,bmi2,popcnt,fma,avx512f,avx512bw,avx512vl,avx512dq," \
                        "avx512vbmi,avx512vbmi2")))

/// A byte for each byte of a register.
struct alignas(64) Table : std::array<std::uint8_t, 64>
{
  GRANULAR_TARGET __m512i load() const noexcept { return _mm512_load_si512(this->data()); }
};

/// A table made from the places of bytes in their lanes, and the numbers of the lanes.
template <std::size_t Bytes, class Make>
constexpr Table by_place(Make make)
{
  Table bytes{};
  for (std::size_t i = 0; i < 64; ++i)
  {
    bytes[i] = static_cast<std::uint8_t>(make(i % Bytes, i / Bytes));
  }
  return bytes;
}

GRANULAR_TARGET inline BlockMarks mark_block(const char* block) noexcept
{
  const __m512i bytes = _mm512_loadu_si512(block);
  return { _mm512_cmpgt_epu8_mask(bytes, _mm512_set1_epi8(' ')),
    _mm512_cmpeq_epi8_mask(bytes, _mm512_set1_epi8('\n')) };
}

GRANULAR_TARGET inline void append(
  std::uint64_t bits, std::uint32_t base, std::uint16_t* to) noexcept
{
  static constexpr Table places = by_place<64>([](std::size_t i, std::size_t) { return i; });
  const __m512i packed = _mm512_maskz_compress_epi8(bits, places.load());
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

constexpr Table short_places = by_place<8>([](std::size_t i, std::size_t) { return i; });

/// Returns the lengths of eight words, by their edges.
GRANULAR_TARGET inline __m256i lengths(const std::uint16_t* edges) noexcept
{
  const __m256i edge = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(edges));
  return _mm256_sub_epi32(
    _mm256_srli_epi32(edge, 16), _mm256_and_si256(edge, _mm256_set1_epi32(0xffff)));
}

/// Words that are parsed together.
constexpr std::uint32_t group = 8;

/// A constant that is kept in a register, or in memory: it is not made anew each time.
GRANULAR_TARGET inline __m512i all_bytes(int value) noexcept
{
  __m512i bytes = _mm512_set1_epi8(static_cast<char>(value));
  asm("" : "+v"(bytes));
  return bytes;
}

/// For doubles.
struct Constants
{
  __m512i zero;
  __m512i minus;
  __m512i point;
  __m512i one;
  __m512i sign_bit;
  __m512i nine;

  GRANULAR_TARGET Constants() noexcept
    : zero(all_bytes('0'))
    , minus(all_bytes('-'))
    , point(all_bytes('.' - '0'))
    , one(all_bytes(1))
    , sign_bit(all_bytes(0x80))
    , nine(all_bytes(9))
  {
  }
};

/// Digits four by four as numbers: in the low half of each 32 bits.
GRANULAR_TARGET inline __m512i combine_fours(__m512i digits) noexcept
{
  const __m512i pairs = _mm512_maddubs_epi16(digits, _mm512_set1_epi16(0x010a));
  return _mm512_madd_epi16(pairs, _mm512_set1_epi32(0x00010064));
}

/// Eight digits of each of eight integers.
struct EightDigits
{
  __m512i value;
  __mmask8 negative;
  bool good;
};

/// The eight bytes that are so many before the ends. start: place of the first that counts, perhaps
/// before these bytes or behind them.
GRANULAR_TARGET inline EightDigits read_digits(
  const char* base, const std::uint16_t* edges, std::ptrdiff_t before, __m256i start) noexcept
{
  const auto text = [&](std::size_t i) GRANULAR_TARGET
  {
    long long bytes;
    std::memcpy(&bytes, base + edges[2 * i + 1] - before, 8);
    return bytes;
  };
  const __m512i word = _mm512_inserti64x4(
    _mm512_castsi256_si512(_mm256_setr_epi64x(text(0), text(1), text(2), text(3))),
    _mm256_setr_epi64x(text(4), text(5), text(6), text(7)), 1);
  const __m512i places = short_places.load();
  const __m512i starts = _mm512_shuffle_epi8(
    _mm512_cvtepu32_epi64(start), _mm512_set4_epi32(0x08080808, 0x08080808, 0, 0));
  const __mmask64 minus = _mm512_mask_cmpeq_epi8_mask(
    _mm512_cmpeq_epi8_mask(places, starts), word, _mm512_set1_epi8('-'));
  __m512i digits =
    _mm512_maskz_sub_epi8(_mm512_cmpge_epi8_mask(places, starts), word, _mm512_set1_epi8('0'));
  digits = _mm512_mask_mov_epi8(digits, minus, _mm512_setzero_si512());
  const __m512i eights =
    _mm512_madd_epi16(combine_fours(digits), _mm512_set1_epi64(0x0000000100002710));
  return { _mm512_add_epi64(_mm512_and_si512(eights, _mm512_set1_epi64(0xffffffff)),
             _mm512_srli_epi64(eights, 32)),
    _mm512_test_epi64_mask(_mm512_movm_epi8(minus), _mm512_set1_epi64(-1)),
    _mm512_cmpgt_epu8_mask(digits, _mm512_set1_epi8(9)) == 0 };
}

/// Eight integers of a sign and digits, of up to 16 characters. False if one is none.
GRANULAR_TARGET inline bool parse_integers(
  const char* base, const std::uint16_t* edges, const Constants&, std::uint64_t* values) noexcept
{
  const __m256i length = lengths(edges);
  EightDigits low = read_digits(base, edges, 8, _mm256_sub_epi32(_mm256_set1_epi32(8), length));
  if (_mm256_cmpgt_epi32_mask(length, _mm256_set1_epi32(8)) != 0)
  {
    const EightDigits high =
      read_digits(base, edges, 16, _mm256_sub_epi32(_mm256_set1_epi32(16), length));
    low.value =
      _mm512_add_epi64(low.value, _mm512_mul_epu32(high.value, _mm512_set1_epi64(100'000'000)));
    low.negative |= high.negative;
    low.good &= high.good && _mm256_cmpgt_epi32_mask(length, _mm256_set1_epi32(16)) == 0;
  }
  _mm512_storeu_si512(
    values, _mm512_mask_sub_epi64(low.value, low.negative, _mm512_setzero_si512(), low.value));
  return low.good && _mm256_mask_cmpeq_epi32_mask(low.negative, length, _mm256_set1_epi32(1)) == 0;
}

template <typename Value>
GRANULAR_TARGET inline bool parse_plain(const char* first, const char* last, Value& value) noexcept
{
  return scan_number(first, last + 8, value) == last;
}

#include "granular/text/row_text_avx512_doubles.inc"
#include "granular/text/row_text_kernel.inc"
}

GRANULAR_TARGET RowResult decode(
  const char* first, const char* last, RowPlan& plan, std::int64_t max_rows) noexcept
{
  return decode_batches(first, last, plan, max_rows);
}
}
#endif
