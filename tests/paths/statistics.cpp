// SPDX-License-Identifier: BSD-3-Clause
// Sums, means and quantiles over ranks: those of exact arithmetic and of sorting, bit for bit.
#include "granular/paths/statistics.h"

#include "granular/common/error.h"

#include "../support/big_sum.h"
#include "../support/hard_case.h"
#include "../support/thread_ranks.h"
#include "path_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace granular;
using path_checks::bits_of;
using path_checks::on_ranks;

namespace
{
using Doubles = std::vector<double>;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// The part of this rank; the last has none of few.
template <class Value>
std::vector<Value> part_of(const std::vector<Value>& all, Communicator& ranks)
{
  std::vector<Value> own;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (static_cast<int>(i * i / 3 % static_cast<std::size_t>(ranks.size())) == ranks.rank())
    {
      own.push_back(all[i]);
    }
  }
  return own;
}

Doubles random_numbers(std::mt19937_64& random, std::size_t count, int least, int greatest)
{
  Doubles numbers;
  for (std::size_t i = 0; i < count; ++i)
  {
    const int exponent =
      least + static_cast<int>(random() % static_cast<std::uint64_t>(greatest - least + 1));
    const double sign = random() % 2 == 0 ? 1 : -1;
    numbers.push_back(
      sign * std::ldexp(1 + static_cast<double>(random() >> 12) * 0x1p-52, exponent));
  }
  return numbers;
}

/// The sum of numbers dealt to the lanes that one sum has.
std::vector<SumScale::Terms> dealt(const Doubles& numbers)
{
  std::vector<SumScale::Terms> terms((numbers.size() + 7) / 8);
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    terms[i / 8][i % 8] = numbers[i];
  }
  return terms;
}

double exact_sum(const Doubles& numbers)
{
  BigSum sum;
  for (const double number : numbers)
  {
    sum.add(number);
  }
  return sum.value();
}

/// The smallest number up to which at least this part of sorted numbers lies, by counting.
double quantile_of(const Doubles& sorted, double part)
{
  const auto count = static_cast<double>(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i)
  {
    if (static_cast<double>(i + 1) / count >= part)
    {
      return sorted[i];
    }
  }
  return sorted.back();
}
}

TEST(ExactSums, OfAnyMagnitudesOnAnyRanks)
{
  HardCase hard(
    "sums", "numbers of 1e-300 to 1e250 on 1 to 5 ranks: sums not correctly rounded", "sums", 0);
  std::mt19937_64 random(4);
  struct Kind
  {
    std::size_t count;
    int least;
    int greatest;
  };
  for (const Kind& kind :
    { Kind{ 1, 0, 0 }, Kind{ 7, -1, 1 }, Kind{ 1000, 0, 3 }, Kind{ 1000, -997, 830 },
      Kind{ 3000, -60, 60 }, Kind{ 50, -1074, -1000 }, Kind{ 500, 880, 899 }, Kind{ 2000, 0, 53 } })
  {
    for (int trial = 0; trial < 4; ++trial)
    {
      Doubles numbers = random_numbers(random, kind.count, kind.least, kind.greatest);
      if (trial % 2 == 1) // cancel to what is small
      {
        const std::size_t half = numbers.size();
        for (std::size_t i = 1; i < half; ++i)
        {
          numbers.push_back(-numbers[i]);
        }
      }
      const double expected = exact_sum(numbers);
      on_ranks(
        [&](Communicator& ranks)
        {
          const SumScale::Terms sums = sum_exactly(dealt(part_of(numbers, ranks)), 1, ranks);
          if (ranks.rank() == 0)
          {
            hard.add(sums[0] == expected ? 0 : 1);
          }
          EXPECT_EQ(sums[0], expected);
        });
    }
  }
}

/// Eight, four, two sums or one, side by side.
TEST(ExactSums, SeveralAtOnce)
{
  std::mt19937_64 random(5);
  const Doubles numbers = random_numbers(random, 800, -40, 40);
  for (const std::size_t sums : { 1U, 2U, 4U, 8U })
  {
    std::vector<Doubles> each(sums);
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      each[i % sums].push_back(numbers[i]);
    }
    on_ranks(
      [&](Communicator& ranks)
      {
        const SumScale::Terms found = sum_exactly(part_of(dealt(numbers), ranks), sums, ranks);
        for (std::size_t i = 0; i < sums; ++i)
        {
          EXPECT_EQ(found[i], exact_sum(each[i]));
        }
      });
  }
}

TEST(ExactSums, OfNothingAndOfZeros)
{
  on_ranks(
    [](Communicator& ranks)
    {
      EXPECT_EQ(sum_exactly({}, 4, ranks)[3], 0);
      const std::vector<SumScale::Terms> zeros(
        ranks.rank() == 0 ? 2 : 0, SumScale::Terms{ -0.0, 0, -0.0 });
      EXPECT_EQ(sum_exactly(zeros, 1, ranks)[0], 0);
    });
}

TEST(ExactSums, TooLarge)
{
  run_ranks(3,
    [](Communicator& ranks)
    {
      const Doubles numbers = { ranks.rank() == 1 ? 0x1p900 : 1 };
      EXPECT_THROW(sum_exactly(dealt(numbers), 1, ranks), LimitError);
      const Doubles largest = { ranks.rank() == 1 ? std::nextafter(0x1p900, 0) : 1 };
      EXPECT_EQ(sum_exactly(dealt(largest), 1, ranks)[0], std::nextafter(0x1p900, 0));
    });
}

TEST(Statistics, AreThoseOfSorting)
{
  std::mt19937_64 random(6);
  const Doubles parts = { 0, 1, 0.5, 0.25, 0.1, 0.9, 1. / 3, 0.99, 0.5, 1e-300, 0.7 };
  for (const std::size_t count : { 1U, 2U, 3U, 10U, 100U, 101U, 1000U, 2999U })
  {
    for (const int kind : { 0, 1, 2 })
    {
      Doubles numbers =
        kind == 0 ? random_numbers(random, count, -3, 3) : random_numbers(random, count, -990, 830);
      for (double& number : numbers)
      {
        number = kind == 2 ? static_cast<double>(random() % 5) - 2 : number; // many are equal
      }
      Doubles sorted = numbers;
      std::ranges::sort(sorted);
      for (const double odd : { nothing, infinity, -infinity, -nothing })
      {
        numbers.push_back(odd);
      }
      std::ranges::shuffle(numbers, random);
      on_ranks(
        [&](Communicator& ranks)
        {
          const Statistics found = find_statistics(part_of(numbers, ranks), parts, ranks);
          ASSERT_EQ(found.count, std::ssize(sorted));
          EXPECT_EQ(found.mean, exact_sum(sorted) / static_cast<double>(count));
          EXPECT_EQ(found.least, sorted.front());
          EXPECT_EQ(found.greatest, sorted.back());
          ASSERT_EQ(found.quantiles.size(), parts.size());
          for (std::size_t i = 0; i < parts.size(); ++i)
          {
            EXPECT_EQ(found.quantiles[i], quantile_of(sorted, parts[i]))
              << parts[i] << " of " << count;
          }
        });
    }
  }
}

/// Every k / n, and the doubles beside it.
TEST(Statistics, QuantilesBetweenTwoNumbers)
{
  SerialCommunicator alone;
  for (const std::size_t count : { 1U, 3U, 7U, 10U, 49U, 100U, 1000U })
  {
    Doubles numbers(count);
    Doubles parts;
    for (std::size_t i = 0; i < count; ++i)
    {
      numbers[i] = static_cast<double>(i);
      const double part = static_cast<double>(i + 1) / static_cast<double>(count);
      parts.insert(
        parts.end(), { std::nextafter(part, 0), part, std::min(1., std::nextafter(part, 2)) });
    }
    const Statistics found = find_statistics(numbers, parts, alone);
    for (std::size_t i = 0; i < parts.size(); ++i)
    {
      ASSERT_EQ(found.quantiles[i], quantile_of(numbers, parts[i])) << i << " of " << count;
    }
  }
}

/// Zeros of both signs are one number, whatever their order.
TEST(Statistics, ZerosAreAlike)
{
  const Doubles quantiles = { 0.5 };
  for (const Doubles& numbers :
    { Doubles{ -0.0 }, Doubles{ -0.0, 0.0, -0.0 }, Doubles{ 0.0, -0.0 }, Doubles{ -1, -0.0, 1 } })
  {
    on_ranks(
      [&](Communicator& ranks)
      {
        const Statistics found = find_statistics(part_of(numbers, ranks), quantiles, ranks);
        EXPECT_EQ(bits_of(found.quantiles), bits_of(Doubles{ 0.0 }));
        EXPECT_TRUE(found.least != 0 || !std::signbit(found.least));
        EXPECT_TRUE(found.greatest != 0 || !std::signbit(found.greatest));
        EXPECT_FALSE(std::signbit(found.mean));
      });
  }
}

TEST(Statistics, OfNothing)
{
  on_ranks(
    [](Communicator& ranks)
    {
      for (const Doubles& numbers : { Doubles{}, Doubles{ nothing, infinity } })
      {
        const Statistics found = find_statistics(numbers, Doubles{ 0.5, 0 }, ranks);
        EXPECT_EQ(found.count, 0);
        EXPECT_TRUE(
          std::isnan(found.mean) && std::isnan(found.least) && std::isnan(found.greatest));
        ASSERT_EQ(found.quantiles.size(), 2U);
        EXPECT_TRUE(std::isnan(found.quantiles[0]) && std::isnan(found.quantiles[1]));
      }
    });
}
