// SPDX-License-Identifier: BSD-3-Clause
#include "granular/text/row_text_detail.h"

#if GRANULAR_X86

#include "granular/common/intrinsics.h"

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

constexpr std::size_t width = 32;
using Register = __m256i;

#include "granular/text/row_text_vectors.inc"

struct Set
{
  GRANULAR_TARGET Set() noexcept {}

  GRANULAR_TARGET static bool any(Half bits) noexcept
  {
    return _mm_testz_si128(__m128i(bits), __m128i(bits)) == 0;
  }

  GRANULAR_TARGET static bool any(Register bits) noexcept
  {
    return _mm256_testz_si256(bits, bits) == 0;
  }

  /// The bytes less limits; 0 where they are not above these.
  GRANULAR_TARGET static Register less(Register bytes, Register limits) noexcept
  {
    return _mm256_subs_epu8(bytes, limits);
  }

  template <class Load>
  GRANULAR_TARGET static Register join(const Load& load) noexcept
  {
    return load(0);
  }

  GRANULAR_TARGET static Register add_byte_pairs(Register bytes, Register factors) noexcept
  {
    return _mm256_maddubs_epi16(bytes, factors);
  }

  GRANULAR_TARGET static Register add_pairs(Register numbers, Register factors) noexcept
  {
    return _mm256_madd_epi16(numbers, factors);
  }

  GRANULAR_TARGET static Register pack(Register a, Register b) noexcept
  {
    return _mm256_packus_epi32(a, b);
  }

  /// Multiplies the low halves of numbers.
  GRANULAR_TARGET static Register multiply_halves(Register a, Register b) noexcept
  {
    return _mm256_mul_epu32(a, b);
  }

  GRANULAR_TARGET static Register widened(Half numbers) noexcept
  {
    return _mm256_cvtepi32_epi64(__m128i(numbers));
  }

  GRANULAR_TARGET static Register shuffle(Register bytes, Register from) noexcept
  {
    return _mm256_shuffle_epi8(bytes, from);
  }

  /// Adds bytes, eight by eight.
  GRANULAR_TARGET static Register add_eight(Register bytes) noexcept
  {
    return _mm256_sad_epu8(bytes, _mm256_setzero_si256());
  }

  GRANULAR_TARGET static Register pick(Half numbers, Register from) noexcept
  {
    return _mm256_shuffle_epi8(_mm256_broadcastsi128_si256(__m128i(numbers)), from);
  }

  /// The sums of bytes times the bytes of a number.
  GRANULAR_TARGET static Half add_digits(Half bytes, int factors) noexcept
  {
    return Half(_mm_madd_epi16(
      _mm_maddubs_epi16(__m128i(bytes), _mm_set1_epi32(factors)), _mm_set1_epi16(1)));
  }

  GRANULAR_TARGET static Half less(Half bytes, Half limits) noexcept
  {
    return Half(_mm_subs_epu8(__m128i(bytes), __m128i(limits)));
  }

  /// The upper and the lower half of numbers, each exact: 2^84 + high * 2^32 and 2^52 + low as their bits, then without them.
  GRANULAR_TARGET __m256d upper(Register numbers) const noexcept
  {
    return __m256d(_mm256_srli_epi64(numbers, 32) | upper_bits) - __m256d(both);
  }

  GRANULAR_TARGET __m256d lower(Register numbers) const noexcept
  {
    return __m256d(_mm256_blend_epi32(numbers, lower_bits, 0xaa));
  }

  /// The nearest doubles.
  GRANULAR_TARGET __m256d nearest(Register numbers) const noexcept
  {
    return upper(numbers) + lower(numbers);
  }

  /// The numbers less their nearest doubles.
  GRANULAR_TARGET __m256d rest(Register numbers, __m256d whole) const noexcept
  {
    const __m256d back = whole - upper(numbers);
    return (upper(numbers) - (whole - back)) + (lower(numbers) - back);
  }

  GRANULAR_TARGET static __m256d fused(__m256d a, __m256d b, __m256d c) noexcept
  {
    return _mm256_fmadd_pd(a, b, c);
  }

  GRANULAR_TARGET static __m256d power_of_ten(Half power) noexcept
  {
    return _mm256_i32gather_pd(powers_of_ten.data(), __m128i(power), 8);
  }

  Register upper_bits = kept(0x4530000000000000); ///< of 2^84
  Register lower_bits = kept(0x4330000000000000); ///< of 2^52
  Register both = kept(std::bit_cast<std::uint64_t>(0x1p84 + 0x1p52));
};

#include "granular/text/row_text_numbers.inc"

#include "granular/text/row_text_kernel.inc"
}

GRANULAR_TARGET RowResult decode(
  const char* first, const char* last, RowPlan& plan, std::int64_t max_rows) noexcept
{
  return decode_batches(first, last, plan, max_rows);
}
}
#endif
