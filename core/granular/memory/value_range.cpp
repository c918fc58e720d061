// SPDX-License-Identifier: BSD-3-Clause
#include "granular/memory/value_range.h"

#include "granular/common/simd.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>

#if GRANULAR_X86
#include <immintrin.h>
#endif

namespace granular
{
namespace
{
/// In registers, unlike what lies behind the object.
struct Extremes
{
  double least = std::numeric_limits<double>::infinity();
  double largest = -std::numeric_limits<double>::infinity();

  void add(double value) noexcept
  {
    least = value < least ? value : least;
    largest = value > largest ? value : largest;
  }

  void join(ValueRange::Bounds& bounds) const noexcept
  {
    bounds = { std::min(bounds[0], least), std::max(bounds[1], largest) };
  }
};

/// Rows of a fixed number of components. Returns whether all are numbers.
template <std::size_t n, typename T>
bool add_rows(const T* values, std::size_t rows, ValueRange::Bounds* components,
  ValueRange::Bounds& squares) noexcept
{
  Extremes each[n];
  Extremes sums;
  std::size_t no_numbers = 0;
  for (std::size_t row = 0; row < rows; ++row, values += n)
  {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
      const auto value = static_cast<double>(values[i]);
      each[i].add(value);
      sum += value * value;
    }
    no_numbers += std::isnan(sum) ? 1U : 0U;
    sums.add(sum);
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    each[i].join(components[i]);
  }
  sums.join(squares);
  return no_numbers == 0;
}

#if GRANULAR_X86
/// Two values at a time, with what every x86-64 has.
struct PairExtremes
{
  __m128d least = _mm_set1_pd(std::numeric_limits<double>::infinity());
  __m128d largest = _mm_set1_pd(-std::numeric_limits<double>::infinity());

  void add(__m128d values) noexcept
  {
    least = _mm_min_pd(values, least); // of one that is no number, the second
    largest = _mm_max_pd(values, largest);
  }

  void join(ValueRange::Bounds& low, ValueRange::Bounds& high) const noexcept
  {
    Extremes{ _mm_cvtsd_f64(least), _mm_cvtsd_f64(largest) }.join(low);
    Extremes{ _mm_cvtsd_f64(_mm_unpackhi_pd(least, least)),
      _mm_cvtsd_f64(_mm_unpackhi_pd(largest, largest)) }
      .join(high);
  }
};

/// As add_rows, for an even number of rows of doubles.
bool add_pairs_1(const double* values, std::size_t rows, ValueRange::Bounds* components,
  ValueRange::Bounds& squares) noexcept
{
  PairExtremes each;
  PairExtremes sums;
  __m128d none = _mm_setzero_pd();
  for (std::size_t row = 0; row < rows; row += 2, values += 2)
  {
    const __m128d value = _mm_loadu_pd(values);
    each.add(value);
    sums.add(_mm_mul_pd(value, value));
    none = _mm_or_pd(none, _mm_cmpunord_pd(value, value));
  }
  each.join(components[0], components[0]);
  sums.join(squares, squares);
  return _mm_movemask_pd(none) == 0;
}

bool add_pairs_3(const double* values, std::size_t rows, ValueRange::Bounds* components,
  ValueRange::Bounds& squares) noexcept
{
  PairExtremes xy;
  PairExtremes zx;
  PairExtremes yz;
  PairExtremes sums;
  __m128d none = _mm_setzero_pd();
  for (std::size_t row = 0; row < rows; row += 2, values += 6)
  {
    const __m128d a = _mm_loadu_pd(values);
    const __m128d b = _mm_loadu_pd(values + 2);
    const __m128d c = _mm_loadu_pd(values + 4);
    xy.add(a);
    zx.add(b);
    yz.add(c);
    const __m128d aa = _mm_mul_pd(a, a);
    const __m128d bb = _mm_mul_pd(b, b);
    const __m128d cc = _mm_mul_pd(c, c);
    const __m128d x = _mm_shuffle_pd(aa, bb, 2);
    const __m128d y = _mm_shuffle_pd(aa, cc, 1);
    const __m128d z = _mm_shuffle_pd(bb, cc, 2);
    const __m128d sum = _mm_add_pd(_mm_add_pd(x, y), z);
    sums.add(sum);
    none = _mm_or_pd(none, _mm_cmpunord_pd(sum, sum));
  }
  xy.join(components[0], components[1]);
  zx.join(components[2], components[0]);
  yz.join(components[1], components[2]);
  sums.join(squares, squares);
  return _mm_movemask_pd(none) == 0;
}
#endif
}

template <typename T>
void ValueRange::add(const T* values, std::size_t rows) noexcept
{
  const std::size_t n = components_.size();
#if GRANULAR_X86
  if constexpr (std::is_same_v<T, double>)
  {
    if (n == 1 || n == 3)
    {
      const std::size_t even = rows / 2 * 2;
      const auto add_pairs = n == 1 ? add_pairs_1 : add_pairs_3;
      numbers_ = add_pairs(values, even, components_.data(), squares_) && numbers_;
      values += even * n;
      rows -= even;
    }
  }
#endif
  if (n == 1)
  {
    numbers_ = add_rows<1>(values, rows, components_.data(), squares_) && numbers_;
    return;
  }
  if (n == 3)
  {
    numbers_ = add_rows<3>(values, rows, components_.data(), squares_) && numbers_;
    return;
  }
  for (std::size_t row = 0; row < rows; ++row, values += n)
  {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i)
    {
      const auto value = static_cast<double>(values[i]);
      Extremes one;
      one.add(value);
      one.join(components_[i]);
      sum += value * value;
    }
    numbers_ = numbers_ && !std::isnan(sum);
    squares_ = { std::min(squares_[0], sum), std::max(squares_[1], sum) };
  }
}

template void ValueRange::add(const double*, std::size_t) noexcept;
template void ValueRange::add(const float*, std::size_t) noexcept;
template void ValueRange::add(const std::int32_t*, std::size_t) noexcept;
template void ValueRange::add(const std::int64_t*, std::size_t) noexcept;

void ValueRange::add(const ValueRange& other) noexcept
{
  for (std::size_t i = 0; i < components_.size(); ++i)
  {
    Extremes{ other.components_[i][0], other.components_[i][1] }.join(components_[i]);
  }
  Extremes{ other.squares_[0], other.squares_[1] }.join(squares_);
  numbers_ = numbers_ && other.numbers_;
}

bool ValueRange::known() const noexcept
{
  return numbers_ && !components_.empty() && squares_[0] <= squares_[1] &&
    std::isfinite(squares_[1]);
}
}
