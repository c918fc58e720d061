// SPDX-License-Identifier: BSD-3-Clause
#include "granular/text/row_text_detail.h"

#if GRANULAR_X86

#include "granular/common/intrinsics.h"

#include <utility>

namespace granular::row_text::avx512
{
namespace
{
#define GRANULAR_TARGET                                                                \
  __attribute__((target("avx2,bmi,bmi2,popcnt,fma,avx512f,avx512bw,avx512vl,avx512dq," \
                        "avx512vbmi,avx512vbmi2")))

constexpr std::size_t width = 64;
using Register = __m512i;

#include "granular/text/row_text_vectors.inc"

GRANULAR_TARGET inline BlockMarks mark_block(const char* block) noexcept
{
  const __m512i bytes = _mm512_loadu_si512(block);
  return { _mm512_cmpgt_epu8_mask(bytes, _mm512_set1_epi8(' ')),
    _mm512_cmpeq_epi8_mask(bytes, _mm512_set1_epi8('\n')) };
}

GRANULAR_TARGET inline void append_edges(
  std::uint64_t bits, std::uint32_t base, Edges& edges) noexcept
{
  static constexpr Table every = by_place<64>([](std::size_t i, std::size_t) { return i; });
  std::uint16_t* const to = edges.offsets + edges.count;
  const __m512i packed = _mm512_maskz_compress_epi8(bits, Register(every.load()));
  const __m512i offset = _mm512_set1_epi16(static_cast<short>(base));
  const __m512i low = _mm512_cvtepu8_epi16(_mm512_maskz_extracti64x4_epi64(0xff, packed, 0));
  _mm512_storeu_si512(to, _mm512_add_epi16(low, offset));
  const int count = __builtin_popcountll(bits);
  if (count > 32)
  {
    const __m512i high = _mm512_cvtepu8_epi16(_mm512_maskz_extracti64x4_epi64(0xff, packed, 1));
    _mm512_storeu_si512(to + 32, _mm512_add_epi16(high, offset));
  }
  edges.count += static_cast<std::uint32_t>(count);
}

struct Set
{
  GRANULAR_TARGET static bool any(Half bits) noexcept
  {
    return _mm256_testz_si256(__m256i(bits), __m256i(bits)) == 0;
  }

  GRANULAR_TARGET static bool any(Register bits) noexcept
  {
    return _mm512_test_epi64_mask(bits, bits) != 0;
  }

  /// The bytes less limits; 0 where they are not above these.
  GRANULAR_TARGET static Register less(Register bytes, Register limits) noexcept
  {
    return _mm512_subs_epu8(bytes, limits);
  }

  template <class Load>
  GRANULAR_TARGET static Register join(const Load& load) noexcept
  {
    return _mm512_inserti64x4(_mm512_castsi256_si512(load(0)), load(1), 1);
  }

  GRANULAR_TARGET static Register add_byte_pairs(Register bytes, Register factors) noexcept
  {
    return _mm512_maddubs_epi16(bytes, factors);
  }

  GRANULAR_TARGET static Register add_pairs(Register numbers, Register factors) noexcept
  {
    return _mm512_madd_epi16(numbers, factors);
  }

  GRANULAR_TARGET static Register pack(Register a, Register b) noexcept
  {
    return _mm512_packus_epi32(a, b);
  }

  /// Multiplies the low halves of numbers.
  GRANULAR_TARGET static Register multiply_halves(Register a, Register b) noexcept
  {
    return _mm512_mul_epu32(a, b);
  }

  GRANULAR_TARGET static Register widened(Half numbers) noexcept
  {
    return _mm512_cvtepi32_epi64(__m256i(numbers));
  }

  GRANULAR_TARGET static Register shuffle(Register bytes, Register from) noexcept
  {
    return _mm512_shuffle_epi8(bytes, from);
  }

  /// Adds bytes, eight by eight.
  GRANULAR_TARGET static Register add_eight(Register bytes) noexcept
  {
    return _mm512_sad_epu8(bytes, _mm512_setzero_si512());
  }

  GRANULAR_TARGET static Register pick(Half numbers, Register from) noexcept
  {
    return _mm512_permutexvar_epi8(from, _mm512_zextsi256_si512(__m256i(numbers)));
  }

  /// The sums of bytes times the bytes of a number.
  GRANULAR_TARGET static Half add_digits(Half bytes, int factors) noexcept
  {
    return Half(_mm256_madd_epi16(
      _mm256_maddubs_epi16(__m256i(bytes), _mm256_set1_epi32(factors)), _mm256_set1_epi16(1)));
  }

  GRANULAR_TARGET static Half less(Half bytes, Half limits) noexcept
  {
    return Half(_mm256_subs_epu8(__m256i(bytes), __m256i(limits)));
  }

  /// The nearest doubles.
  GRANULAR_TARGET static __m512d nearest(Register numbers) noexcept
  {
    return _mm512_cvtepu64_pd(numbers);
  }

  /// The numbers less their nearest doubles.
  GRANULAR_TARGET static __m512d rest(Register numbers, __m512d whole) noexcept
  {
    return _mm512_cvtepi64_pd(_mm512_sub_epi64(numbers, _mm512_cvtpd_epu64(whole)));
  }

  GRANULAR_TARGET static __m512d fused(__m512d a, __m512d b, __m512d c) noexcept
  {
    return _mm512_fmadd_pd(a, b, c);
  }

  GRANULAR_TARGET static __m512d power_of_ten(Half power) noexcept
  {
    return _mm512_permutex2var_pd(_mm512_loadu_pd(powers_of_ten.data()),
      _mm512_cvtepu32_epi64(__m256i(power)), _mm512_loadu_pd(powers_of_ten.data() + 8));
  }
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
