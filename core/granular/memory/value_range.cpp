// SPDX-License-Identifier: BSD-3-Clause
#include "granular/memory/value_range.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace granular
{
namespace
{
/// Extends bounds; nan changes nothing.
void extend(ValueRange::Bounds& bounds, double least, double largest) noexcept
{
  bounds = { std::min(bounds[0], least), std::max(bounds[1], largest) };
}

/// Two values at a time, in whatever registers there are.
using Pair [[gnu::vector_size(16)]] = double;

/// In registers, unlike what lies behind the object.
struct Extremes
{
  Pair least = Pair{} + std::numeric_limits<double>::infinity();
  Pair largest = Pair{} - std::numeric_limits<double>::infinity();

  void add(Pair values) noexcept
  {
    least = values < least ? values : least;
    largest = values > largest ? values : largest;
  }

  void join(ValueRange::Bounds& low, ValueRange::Bounds& high) const noexcept
  {
    extend(low, least[0], largest[0]);
    extend(high, least[1], largest[1]);
  }
};

/// Rows of one or three components, two by two; the last one alone is taken twice. Returns whether all are numbers.
template <std::size_t n, typename T>
bool add_rows(const T* values, std::size_t rows, ValueRange::Bounds* components,
  ValueRange::Bounds& squares) noexcept
{
  Extremes each[n];
  Extremes sums;
  auto none = Pair{} != Pair{};
  T last[2 * n];
  for (std::size_t row = 0; row < rows; row += 2, values += 2 * n)
  {
    if (row + 1 == rows)
    {
      std::copy_n(std::copy_n(values, n, last) - n, n, last + n);
      values = last;
    }
    Pair powers[n];
    for (std::size_t i = 0; i < n; ++i)
    {
      const Pair pair = { static_cast<double>(values[2 * i]),
        static_cast<double>(values[2 * i + 1]) };
      each[i].add(pair);
      powers[i] = pair * pair;
    }
    Pair sum = powers[0];
    if constexpr (n == 3)
    {
      sum = __builtin_shufflevector(powers[0], powers[1], 0, 3) +
        __builtin_shufflevector(powers[0], powers[2], 1, 2) +
        __builtin_shufflevector(powers[1], powers[2], 0, 3);
    }
    sums.add(sum);
    none |= sum != sum; // NOLINT(misc-redundant-expression): not a number
  }
  for (std::size_t i = 0; i < n; ++i)
  {
    each[i].join(components[2 * i % n], components[(2 * i + 1) % n]);
  }
  sums.join(squares, squares);
  return (none[0] | none[1]) == 0;
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
      extend(components_[i], value, value);
      sum += value * value;
    }
    numbers_ = numbers_ && !std::isnan(sum);
    extend(squares_, sum, sum);
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
    extend(components_[i], other.components_[i][0], other.components_[i][1]);
  }
  extend(squares_, other.squares_[0], other.squares_[1]);
  numbers_ = numbers_ && other.numbers_;
}

bool ValueRange::known() const noexcept
{
  return numbers_ && !components_.empty() && squares_[0] <= squares_[1] &&
    std::isfinite(squares_[1]);
}
}
