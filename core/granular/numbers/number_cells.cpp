// SPDX-License-Identifier: BSD-3-Clause
#include "granular/numbers/number_print.h"

#include "granular/numbers/number_print_few.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#if GRANULAR_X86
#include "granular/common/intrinsics.h"
#endif

namespace granular
{
namespace
{
constexpr std::int64_t ahead = 256; ///< so many numbers later they are fetched from memory, early

/// A loop of its own for each kind of number, so that what is the same for all is asked once.
template <class Number, class Print>
[[gnu::always_inline]] inline void print_all(const Number* from, std::int64_t step,
  std::size_t count, const NumberCells& to, Print&& print) noexcept
{
  const NumberCells cells = to; // not read again after each character
  char* cell = cells.text;
  std::uint8_t* length = cells.lengths;
  for (std::size_t i = 0; i < count; ++i)
  {
    __builtin_prefetch(from + ahead * step);
    char* const end = print(cell, *from);
    std::memcpy(end, cells.end.data(), cells.end.size());
    *length = static_cast<std::uint8_t>(end - cell + cells.end_chars);
    from += step;
    cell += cells.step * most_number_chars;
    length += cells.step;
  }
}

constexpr int few = 6;

char* print_few(char* cell, double value) noexcept
{
  using namespace number_print;
  const std::uint64_t magnitude = std::bit_cast<std::uint64_t>(value) & ~sign_bit;
  if (is_usual(magnitude)) [[likely]]
  {
    const Rounded rounded = round_few(magnitude, few);
    if (rounded.sure) [[likely]]
    {
      return lay_out_few(cell, value, rounded, few);
    }
  }
  return print_number(cell, value, { few });
}

#if GRANULAR_X86
/// Numbers and their digits. Digits are one per byte, the first in the lowest, and then two zeros; the first one has the weight
/// 10^k.
struct alignas(64) SixDigits
{
  static constexpr std::size_t most = 64;
  static constexpr std::int64_t not_found = std::numeric_limits<std::int64_t>::min(); ///< as k

  std::array<double, most> values;
  std::array<std::uint64_t, most> digits;
  std::array<std::int64_t, most> k;
};

// The way to the six digits of x, for 2^-33 <= |x| < 10^6:
// 1. k is the exponent of the first digit: 10^k <= |x| < 10^(k + 1), here -10 <= k <= 5. With 2^e the largest power of two up to
//    |x|, k is floor(e * log10(2)) or one more; a comparison with 10^(k + 1) decides. 78913 / 2^18 gives the same floor as
//    log10(2) for all these e. Below 2^-33 the floor is -11, outside of the tables.
// 2. |x| * 10^(5 - k) has six digits before the point. The power is at most 10^15, an exact double, so the product is rounded
//    only once.
// 3. The halves between integers below 10^6 are doubles, too. Rounding is monotonic: it can move the product onto a half, but
//    not across. A product that is exactly a half is left to the caller. Every other one has the nearest integer of the exact
//    product.
// 4. A product from 999999.5 on gives 10^6: the digits are 100000, with k + 1. Negative powers of ten are rounded, so the
//    comparison may take a number just below one for the power itself; the digits are 100000 either way.
constexpr double least_six = 0x1p-33;
constexpr double end_six = 1e6;
constexpr int least_k = -10;
constexpr std::int64_t log_of_two = 78913;
constexpr int log_bits = 18;
constexpr std::int64_t exponent_bias = 1023;

/// 10^(k + 1), by k - least_k.
alignas(64) constexpr std::array<double, 16> next_powers = { 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4,
  1e-3, 1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6 };

/// 10^(5 - k), by k - least_k.
alignas(64) constexpr std::array<double, 16> powers = { 1e15, 1e14, 1e13, 1e12, 1e11, 1e10, 1e9,
  1e8, 1e7, 1e6, 1e5, 1e4, 1e3, 1e2, 1e1, 1e0 };

#define GRANULAR_AVX2 __attribute__((target("avx2")))

/// As number_print::eight_digits, for four numbers.
GRANULAR_AVX2 inline __m256i eight_digits(__m256i x) noexcept
{
  const __m256i high = _mm256_srli_epi64(_mm256_mul_epu32(x, _mm256_set1_epi64x(3518437209)), 45);
  const __m256i low = _mm256_sub_epi64(x, _mm256_mul_epu32(high, _mm256_set1_epi64x(10000)));
  const __m256i halves = _mm256_or_si256(_mm256_slli_epi64(low, 32), high);
  const __m256i hundreds =
    _mm256_srli_epi32(_mm256_mullo_epi32(halves, _mm256_set1_epi32(10486)), 20);
  const __m256i pairs = _mm256_sub_epi32(_mm256_slli_epi32(halves, 16),
    _mm256_mullo_epi32(hundreds, _mm256_set1_epi32((100 << 16) - 1)));
  const __m256i tens = _mm256_mulhi_epu16(pairs, _mm256_set1_epi16(103 << 6));
  return _mm256_sub_epi16(
    _mm256_slli_epi16(pairs, 8), _mm256_mullo_epi16(tens, _mm256_set1_epi16((10 << 8) - 1)));
}

GRANULAR_AVX2 void find_by_avx2(SixDigits& numbers, std::size_t at) noexcept
{
  const __m256d magnitude = _mm256_castsi256_pd(_mm256_set1_epi64x(~(std::int64_t{ 1 } << 63)));
  const __m256d any = _mm256_and_pd(_mm256_load_pd(&numbers.values[at]), magnitude);
  const __m256d usual = _mm256_and_pd(_mm256_cmp_pd(any, _mm256_set1_pd(least_six), _CMP_GE_OQ),
    _mm256_cmp_pd(any, _mm256_set1_pd(end_six), _CMP_LT_OQ));
  // 1 stands for all other numbers: it keeps the places inside the tables, and gives 0 k = 0
  const __m256d x = _mm256_blendv_pd(_mm256_set1_pd(1), any, usual);
  const __m256i exponent = _mm256_srli_epi64(_mm256_castpd_si256(x), 52);
  const __m256i bias =
    _mm256_set1_epi64x(exponent_bias * log_of_two + least_k * (std::int64_t{ 1 } << log_bits));
  const __m256i at_least = _mm256_srli_epi64( // k - least_k, or one less
    _mm256_sub_epi64(_mm256_mul_epu32(exponent, _mm256_set1_epi64x(log_of_two)), bias), log_bits);
  const __m256d next = _mm256_i64gather_pd(next_powers.data(), at_least, 8);
  const __m256i place =
    _mm256_sub_epi64(at_least, _mm256_castpd_si256(_mm256_cmp_pd(x, next, _CMP_GE_OQ)));
  const __m256d product = _mm256_mul_pd(x, _mm256_i64gather_pd(powers.data(), place, 8));
  const __m256d whole = _mm256_round_pd(product, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
  const __m256d off = _mm256_and_pd(_mm256_sub_pd(product, whole), magnitude);
  const __m256d zero = _mm256_cmp_pd(any, _mm256_setzero_pd(), _CMP_EQ_OQ);
  const __m256d found = _mm256_or_pd(
    _mm256_andnot_pd(_mm256_cmp_pd(off, _mm256_set1_pd(0.5), _CMP_EQ_OQ), usual), zero);
  const __m256d carries = _mm256_cmp_pd(whole, _mm256_set1_pd(end_six), _CMP_EQ_OQ);
  const __m256d six = _mm256_blendv_pd(whole, _mm256_set1_pd(end_six / 10), carries);
  const __m256i eight =
    _mm256_cvtepu32_epi64(_mm256_cvtpd_epi32(_mm256_mul_pd(six, _mm256_set1_pd(100))));
  const __m256i k = _mm256_add_epi64(
    _mm256_sub_epi64(place, _mm256_castpd_si256(carries)), _mm256_set1_epi64x(least_k));
  const __m256i none = _mm256_set1_epi64x(SixDigits::not_found);
  _mm256_store_si256(reinterpret_cast<__m256i*>(&numbers.digits[at]),
    _mm256_andnot_si256(_mm256_castpd_si256(zero), eight_digits(eight)));
  _mm256_store_si256(reinterpret_cast<__m256i*>(&numbers.k[at]),
    _mm256_blendv_epi8(none, k, _mm256_castpd_si256(found)));
}

/// Finds six digits of the first `count` values, rounded as by printf's %.6g, without signs; 0 has six zeros and k = 0. k is
/// not_found for nan, for other magnitudes below 2^-33 or from 10^6 on, and where the value times a power of ten rounds to
/// exactly half. Values from `count` up to a multiple of four may be overwritten.
void find_six_digits(SixDigits& numbers, std::size_t count) noexcept
{
  constexpr std::size_t lanes = 4;
  static_assert(SixDigits::most % lanes == 0); // so the last lanes stay in the arrays
  while (count % lanes != 0)
  {
    numbers.values[count++] = 0;
  }
  for (std::size_t at = 0; at < count; at += lanes)
  {
    find_by_avx2(numbers, at);
  }
}

/// Prints numbers whose digits are found together.
void print_together(
  const double* from, std::int64_t step, std::size_t count, const NumberCells& to) noexcept
{
  SixDigits numbers;
  for (std::size_t first = 0; first < count; first += SixDigits::most)
  {
    const std::size_t some = std::min(SixDigits::most, count - first);
    for (std::size_t i = 0; i < some; ++i, from += step)
    {
      __builtin_prefetch(from + ahead * step);
      numbers.values[i] = *from;
    }
    find_six_digits(numbers, some);
    NumberCells cells = to;
    cells.text += first * to.step * most_number_chars;
    cells.lengths += first * to.step;
    print_all(numbers.values.data(), 1, some, cells,
      [&numbers, i = std::size_t{ 0 }](char* cell, double value) mutable
      {
        const std::size_t at = i++;
        return numbers.k[at] != SixDigits::not_found
          ? number_print::lay_out_six(
              cell, value, numbers.digits[at], static_cast<int>(numbers.k[at]))
          : print_few(cell, value);
      });
  }
}
#endif
}

void print_numbers(const double* from, std::int64_t step, std::size_t count, NumberFormat format,
  bool whole, const NumberCells& to, Simd simd) noexcept
{
  constexpr double most_exact = 9007199254740992.0; // 2^53
  [[maybe_unused]] constexpr std::size_t many = 4;  // fewer are printed as fast one by one
  static_cast<void>(simd);
  if (whole)
  {
    print_all(from, step, count, to,
      [format](char* cell, double value)
      {
        return std::abs(value) < most_exact && std::trunc(value) == value
          ? number_print::print_whole(cell, static_cast<std::int64_t>(value))
          : print_number(cell, value, format);
      });
  }
  else if (format != NumberFormat{ few })
  {
    print_all(from, step, count, to,
      [format](char* cell, double value) { return print_number(cell, value, format); });
  }
#if GRANULAR_X86
  else if (simd != Simd::Portable && count >= many)
  {
    print_together(from, step, count, to);
  }
#endif
  else
  {
    print_all(from, step, count, to, print_few);
  }
}

void print_integers(
  const std::int32_t* from, std::int64_t step, std::size_t count, const NumberCells& to) noexcept
{
  print_all(from, step, count, to,
    [](char* cell, std::int32_t value) { return number_print::print_whole(cell, value); });
}

void print_integers(
  const std::int64_t* from, std::int64_t step, std::size_t count, const NumberCells& to) noexcept
{
  print_all(from, step, count, to,
    [](char* cell, std::int64_t value) { return number_print::print_whole(cell, value); });
}
}
