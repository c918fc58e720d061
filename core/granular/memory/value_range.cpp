// SPDX-License-Identifier: BSD-3-Clause
#include "granular/memory/value_range.h"

#include "granular/common/simd.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

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

/// Two values side by side, as doubles.
__m128d load_pair(const double* values) noexcept
{
  return _mm_loadu_pd(values);
}

__m128d load_pair(const float* values) noexcept
{
  return _mm_set_pd(static_cast<double>(values[1]), static_cast<double>(values[0]));
}

__m128d load_pair(const std::int32_t* values) noexcept
{
  return _mm_cvtepi32_pd(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(values)));
}

__m128d load_pair(const std::int64_t* values) noexcept
{
  return _mm_set_pd(static_cast<double>(values[1]), static_cast<double>(values[0]));
}

/// The sums of the squares of two rows of one or three components.
template <std::size_t n>
__m128d sum_rows(const __m128d* squares) noexcept
{
  if constexpr (n == 1)
  {
    return squares[0];
  }
  else
  {
    const __m128d x = _mm_shuffle_pd(squares[0], squares[1], 2);
    const __m128d y = _mm_shuffle_pd(squares[0], squares[2], 1);
    const __m128d z = _mm_shuffle_pd(squares[1], squares[2], 2);
    return _mm_add_pd(_mm_add_pd(x, y), z);
  }
}

/// As add_rows, for an even number of rows.
template <std::size_t n, typename T>
bool add_pairs(const T* values, std::size_t rows, ValueRange::Bounds* components,
  ValueRange::Bounds& squares) noexcept
{
  PairExtremes each[n];
  PairExtremes sums;
  __m128d none = _mm_setzero_pd();
  for (std::size_t row = 0; row < rows; row += 2, values += 2 * n)
  {
    __m128d powers[n];
    for (std::size_t i = 0; i < n; ++i)
    {
      const __m128d pair = load_pair(values + 2 * i);
      each[i].add(pair);
      powers[i] = _mm_mul_pd(pair, pair);
    }
    const __m128d sum = sum_rows<n>(powers);
    sums.add(sum);
    none = _mm_or_pd(none, _mm_cmpunord_pd(sum, sum));
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    each[i].join(components[2 * i % n], components[(2 * i + 1) % n]);
  }
  sums.join(squares, squares);
  return _mm_movemask_pd(none) == 0;
}
#endif

/// Rows of one or three components. Returns whether all are numbers.
template <std::size_t n, typename T>
bool add_rows(const T* values, std::size_t rows, ValueRange::Bounds* components,
  ValueRange::Bounds& squares) noexcept
{
  std::size_t row = 0;
  bool numbers = true;
#if GRANULAR_X86
  row = rows / 2 * 2;
  numbers = add_pairs<n>(values, row, components, squares);
  values += row * n;
#endif
  Extremes each[n];
  Extremes sums;
  std::size_t no_numbers = 0;
  for (; row < rows; ++row, values += n)
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
  return numbers && no_numbers == 0;
}
}

template <typename T>
void ValueRange::add(const T* values, std::size_t rows) noexcept
{
  const std::size_t n = components_.size();
  if (n == 1 || n == 3)
  {
    const auto add_all = n == 1 ? add_rows<1, T> : add_rows<3, T>;
    numbers_ = add_all(values, rows, components_.data(), squares_) && numbers_;
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
