// SPDX-License-Identifier: BSD-3-Clause
#include "granular/memory/value_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <vector>

using granular::ValueRange;

namespace
{
/// Values that are neither sorted nor symmetric, among them those that another type would change. All are multiples of a half,
/// and one of a row is large at most, so that sums are the same in any order.
template <typename T>
std::vector<T> make_values(std::size_t count)
{
  using Limits = std::numeric_limits<T>;
  std::vector<T> rare = { static_cast<T>(-99'999), static_cast<T>(70'000) };
  if constexpr (Limits::is_integer)
  {
    rare.insert(rare.end(), { Limits::max(), Limits::min(), Limits::max() / 3 });
  }
  else
  {
    rare.insert(rare.end(), { static_cast<T>(-300.5), static_cast<T>(0.5), static_cast<T>(1e12) });
  }
  std::vector<T> values;
  for (std::size_t i = 0; i < count; ++i)
  {
    const bool usual = i % 7 != 3 || i / 7 % 2 != 0;
    values.push_back(
      usual ? static_cast<T>(static_cast<int>(i * 7919 % 1009) - 300) : rare[i / 14 % rare.size()]);
  }
  return values;
}

template <typename T>
void expect_range(std::size_t rows, std::size_t components)
{
  const std::vector<T> values = make_values<T>(rows * components);
  ValueRange range(components);
  const std::size_t first = rows / 3; // in two parts
  range.add(values.data(), first);
  range.add(values.data() + first * components, rows - first);
  std::vector<ValueRange::Bounds> bounds(components, { 1e300, -1e300 });
  ValueRange::Bounds squares = { 1e300, -1e300 };
  for (std::size_t row = 0; row < rows; ++row)
  {
    double sum = 0;
    for (std::size_t i = 0; i < components; ++i)
    {
      const auto value = static_cast<double>(values[row * components + i]);
      bounds[i] = { std::fmin(bounds[i][0], value), std::fmax(bounds[i][1], value) };
      sum += value * value;
    }
    squares = { std::fmin(squares[0], sum), std::fmax(squares[1], sum) };
  }
  ASSERT_TRUE(range.known());
  EXPECT_EQ(range.components(), bounds) << rows << " rows of " << components;
  EXPECT_EQ(range.squares(), squares) << rows << " rows of " << components;
}
}

TEST(ValueRange, OfAllTypesAndSizes)
{
  for (std::size_t components = 1; components <= 5; ++components)
  {
    for (const std::size_t rows : { 1u, 2u, 3u, 4u, 7u, 100u, 1001u })
    {
      expect_range<double>(rows, components);
      expect_range<float>(rows, components);
      expect_range<std::int32_t>(rows, components);
      expect_range<std::int64_t>(rows, components);
    }
  }
}

template <typename T>
void expect_unknown(std::initializer_list<double> odd_values)
{
  for (const double odd : odd_values)
  {
    for (const std::size_t components : { 1u, 2u, 3u })
    {
      for (std::size_t at = 0; at < 8 * components; ++at)
      {
        std::vector<T> values = make_values<T>(8 * components);
        values[at] = static_cast<T>(odd);
        ValueRange range(components);
        range.add(values.data(), 8);
        EXPECT_FALSE(range.known()) << odd << " at " << at << " of " << components;
        ValueRange joined(components);
        joined.add(range);
        EXPECT_FALSE(joined.known());
      }
    }
  }
}

TEST(ValueRange, IsNotKnownWhereAValueIsNotFinite)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  expect_unknown<double>({ infinity, -infinity, std::nan(""), 1e200 });
  expect_unknown<float>({ infinity, -infinity, std::nan("") });
}

TEST(ValueRange, IsNotKnownOfNothing)
{
  const double value = 1;
  ValueRange none(1);
  none.add(&value, 0);
  EXPECT_FALSE(none.known());
  EXPECT_FALSE(ValueRange().known());
  none.add(&value, 1);
  EXPECT_TRUE(none.known());
}

TEST(ValueRange, JoinsOthers)
{
  const std::vector<double> values = { 1, -2, 3, 4, 5, -6 };
  ValueRange all(2);
  for (std::size_t row = 0; row < 3; ++row)
  {
    ValueRange one(2);
    one.add(values.data() + 2 * row, 1);
    all.add(one);
  }
  all.add(ValueRange(2));
  EXPECT_EQ(all.components(), (std::vector<ValueRange::Bounds>{ { 1, 5 }, { -6, 4 } }));
  EXPECT_EQ(all.squares(), (ValueRange::Bounds{ 5, 61 }));
}
