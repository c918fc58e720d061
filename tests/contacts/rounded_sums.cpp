// SPDX-License-Identifier: BSD-3-Clause
// Sums of doubles, held against sums of large integers, against 128 bits, and against halves by hand.
#include "granular/geometry/reproducible_sum.h"

#include "../support/big_sum.h"
#include "../support/hard_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <vector>

namespace
{
using granular::ExactSum;
using granular::RoundedSums;
using Terms = std::vector<double>;

__extension__ using Wide = __int128;

/// As RoundedSums has it; nothing where it asks for the terms again.
std::optional<double> quick_sum(const Terms& terms)
{
  RoundedSums<1> sums;
  for (const double& term : terms)
  {
    sums.add(std::span<const double, 1>(&term, 1));
  }
  double sum = 0;
  return sums.round(0, sum) ? std::optional(sum) : std::nullopt;
}

double slow_sum(const Terms& terms)
{
  ExactSum sum;
  for (const double term : terms)
  {
    sum.add(term);
  }
  return sum.rounded();
}

double true_sum(const Terms& terms)
{
  BigSum sum;
  for (const double term : terms)
  {
    sum.add(term);
  }
  return sum.value();
}

/// How many of both are wrong; how many were refused is counted.
int wrong_sums(const Terms& terms, double expected, int& refused)
{
  const std::optional<double> quick = quick_sum(terms);
  refused += quick ? 0 : 1;
  return (quick.value_or(expected) != expected ? 1 : 0) + (slow_sum(terms) != expected ? 1 : 0);
}

/// 53 bits, and a power of two from `least` to `most`.
double random_term(std::mt19937_64& random, int least, int most)
{
  const auto mantissa = static_cast<double>(static_cast<std::int64_t>(random()) >> 10);
  const auto powers = static_cast<std::uint64_t>(most - least + 1);
  return std::ldexp(mantissa, least + static_cast<int>(random() % powers) - 53);
}

/// The same terms with their opposites, but for what is left.
Terms cancelled(Terms terms, const Terms& left, std::mt19937_64& random)
{
  const std::size_t size = terms.size();
  for (std::size_t i = 0; i < size; ++i)
  {
    terms.push_back(-terms[i]);
  }
  terms.insert(terms.end(), left.begin(), left.end());
  std::ranges::shuffle(terms, random);
  return terms;
}
}

/// The reference itself, where the sum is known.
TEST(BigSum, KnownSums)
{
  const auto sum = [](const Terms& terms) { return true_sum(terms); };
  constexpr double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(sum({}), 0);
  EXPECT_EQ(sum({ 1, 2, -4 }), -1);
  EXPECT_EQ(sum({ 0.1 }), 0.1);
  EXPECT_EQ(sum({ least, -0x1p900, 0x1p900 }), least);
  EXPECT_EQ(sum({ 3 * least, -5 * least }), -2 * least);
  EXPECT_EQ(sum({ 1, 0x1p-53 }), 1);
  EXPECT_EQ(sum({ 1, 0x1p-53, least }), 1 + 0x1p-52);
  EXPECT_EQ(sum({ -1, -0x1p-52, -0x1p-53 }), -1 - 0x1p-51);
  EXPECT_EQ(sum({ 0x1p1000, -1, -0x1p1000 }), -1);
}

TEST(RoundedSums, RandomTermsOfAnySize)
{
  HardCase hard("sums",
    "contacts: 1 to 300 terms of like size up to 600 orders of magnitude apart, most of which "
    "cancel: not the nearest "
    "double",
    "sums", 0);
  std::mt19937_64 random(1);
  const std::array<std::array<int, 2>, 6> powers = { { { 0, 0 }, { -4, 4 }, { -60, 60 },
    { -200, 200 }, { -1021, 898 }, { -1074, -1000 } } };
  std::array<int, 6> refused = {};
  for (int trial = 0; trial < 3000; ++trial)
  {
    const std::size_t kind = random() % powers.size();
    const auto [least, most] = powers[kind];
    Terms terms(1 + random() % (trial % 2 == 0 ? 300 : 8));
    std::ranges::generate(
      terms, [&, least = least, most = most] { return random_term(random, least, most); });
    if (trial % 3 == 0)
    {
      terms = cancelled(terms, { random_term(random, least, least) }, random);
    }
    hard.add(wrong_sums(terms, true_sum(terms), refused[kind]));
  }
  // as a rule sums are known at once
  EXPECT_EQ(refused[0] + refused[1], 0);
  EXPECT_GT(refused[4], 0);
}

TEST(RoundedSums, ForcesThatCancel)
{
  HardCase hard("sums",
    "contacts: terms that cancel exactly, or to 1e-12 or 1e-40 of the largest: not the nearest "
    "double",
    "sums", 0);
  std::mt19937_64 random(2);
  int refused = 0;
  for (int trial = 0; trial < 2000; ++trial)
  {
    Terms terms(1 + random() % 20);
    std::ranges::generate(terms, [&] { return random_term(random, -3, 3); });
    const double tiny = trial % 2 == 0 ? 0x1p-40 : 0x1p-133;
    const Terms left = trial % 4 < 2 ? Terms{ tiny, tiny / 3 } : Terms{};
    const double expected = trial % 4 < 2 ? tiny + tiny / 3 : 0;
    hard.add(wrong_sums(cancelled(terms, left, random), expected, refused));
  }
}

/// Halfway between two doubles the even one; a remainder on either side, however small, decides.
TEST(RoundedSums, Halves)
{
  HardCase hard("sums",
    "contacts: halfway between two doubles, with remainders from 2^-60 to 2^-1074 on either side, "
    "in any order: not the "
    "nearest double",
    "sums", 0);
  int refused = 0;
  for (const double base : { 1.0, 1 + 0x1p-52, 1.5, 2 - 0x1p-52, 0x1p700, 0x1.23456789abcdep-500 })
  {
    const double ulp = std::nextafter(base, HUGE_VAL) - base;
    const bool even = std::fmod(base / ulp, 2) == 0;
    for (int power = 7; power < 600; power += power < 120 ? 1 : 53)
    {
      for (const int side : { -1, 0, 1 })
      {
        const double rest = side * std::max(std::ldexp(ulp, -power), 0x1p-1073);
        // the sum is written in three ways
        for (Terms terms : { Terms{ base, ulp / 2, rest }, Terms{ base + ulp, -ulp / 2, rest },
               Terms{ base - ulp, 1.5 * ulp, rest / 2, rest / 2 } })
        {
          const double nearest = side < 0 || (side == 0 && even) ? base : base + ulp;
          std::ranges::sort(terms);
          do
          {
            hard.add(wrong_sums(terms, nearest, refused));
            Terms opposite = terms;
            std::ranges::transform(opposite, opposite.begin(), std::negate<>());
            hard.add(wrong_sums(opposite, -nearest, refused));
          } while (std::ranges::next_permutation(terms).found);
        }
      }
    }
  }
  EXPECT_GT(refused, 0);
}

/// Next to a power of two doubles are closer below than above.
TEST(RoundedSums, HalvesBelowPowersOfTwo)
{
  int refused = 0;
  for (const double base : { 1.0, 0x1p300, 0x1p-900 })
  {
    const double below = base * 0x1p-53; // to the next double
    const double rest = base * 0x1p-160;
    EXPECT_EQ(wrong_sums({ base, -below / 2 }, base, refused), 0);
    EXPECT_EQ(wrong_sums({ base, -below / 2, -rest }, base - below, refused), 0);
    EXPECT_EQ(wrong_sums({ base, -below / 2, rest }, base, refused), 0);
    EXPECT_EQ(wrong_sums({ base, -below, -below / 2 }, base - 2 * below, refused), 0);
    EXPECT_EQ(wrong_sums({ base, -below, -below / 2, rest }, base - below, refused), 0);
    EXPECT_EQ(wrong_sums({ base, below }, base, refused), 0);
    EXPECT_EQ(wrong_sums({ base, below, rest }, base + 2 * below, refused), 0);
    EXPECT_EQ(wrong_sums({ base, below, -rest }, base, refused), 0);
  }
}

/// As integers of 128 bits, whose conversion rounds once.
TEST(RoundedSums, HundredThousandTerms)
{
  HardCase hard(
    "sums", "contacts: 10^5 terms over 60 bits, in any order: not the nearest double", "sums", 0);
  std::mt19937_64 random(3);
  int refused = 0;
  for (int trial = 0; trial < 6; ++trial)
  {
    Terms terms(100000);
    Wide whole = 0;
    for (double& term : terms)
    {
      const auto mantissa = static_cast<std::int64_t>(random() >> 12) - (std::int64_t{ 1 } << 51);
      const int power = static_cast<int>(random() % 60);
      term = std::ldexp(static_cast<double>(mantissa), power - 300);
      whole += static_cast<Wide>(mantissa) << power;
    }
    const double expected = std::ldexp(static_cast<double>(whole), -300);
    hard.add(wrong_sums(terms, expected, refused));
    std::ranges::sort(terms);
    hard.add(wrong_sums(terms, expected, refused));
    std::ranges::sort(terms, {}, [](double term) { return std::abs(term); });
    hard.add(wrong_sums(terms, expected, refused));
  }
  EXPECT_EQ(refused, 0);
}

/// What is beyond the third double makes round() ask for the terms, where the middle is next to it.
TEST(RoundedSums, RefusesWhatItCannotKnow)
{
  for (const double rest : { 0x1p-110, -0x1p-110, 0x1p-160, -0x1p-160 })
  {
    const Terms middle = { 1, 0x1p-53, 0x1p-108, rest, -0x1p-108 };
    EXPECT_FALSE(quick_sum(middle)) << rest;
    EXPECT_EQ(slow_sum(middle), rest > 0 ? 1 + 0x1p-52 : 1);
    // far from the middle the same rest is no reason
    const Terms far = { 1, 0x1p-54, 0x1p-108, rest, -0x1p-108 };
    EXPECT_EQ(quick_sum(far), std::optional(1.0)) << rest;
  }
}

TEST(RoundedSums, SmallestNumbers)
{
  constexpr double least = std::numeric_limits<double>::denorm_min();
  int refused = 0;
  EXPECT_EQ(wrong_sums({ least, least, -3 * least }, -least, refused), 0);
  EXPECT_EQ(wrong_sums({ 0x1p-1022, -least }, 0x1p-1022 - least, refused), 0);
  EXPECT_EQ(wrong_sums({ 0x1p899, least, -0x1p899 }, least, refused), 0);
  EXPECT_EQ(wrong_sums({ 0x1p899, 0x1p-1022, least, -0x1p899, -least }, 0x1p-1022, refused), 0);
  EXPECT_EQ(wrong_sums({ 1, 0x1p-53, least }, 1 + 0x1p-52, refused), 0);
  EXPECT_EQ(wrong_sums({ 1, 0x1p-53, -least }, 1, refused), 0);
  // zeros have no sign
  for (const Terms& terms : { Terms{}, Terms{ -0.0 }, Terms{ -0.0, -0.0 }, Terms{ 3, -3 } })
  {
    EXPECT_FALSE(std::signbit(*quick_sum(terms)));
    EXPECT_FALSE(std::signbit(slow_sum(terms)));
  }
}

/// A bit at each second place between the smallest and the largest: as many doubles as there can be.
TEST(ExactSum, AllBits)
{
  std::mt19937_64 random(4);
  for (const int step : { 1, 2, 3, 53, 54, 60 })
  {
    Terms terms;
    for (int power = -1074; power < 900; power += step)
    {
      terms.push_back(std::ldexp(random() % 2 == 0 ? 1 : -1, power));
    }
    const double expected = true_sum(terms);
    for (int trial = 0; trial < 20; ++trial)
    {
      EXPECT_EQ(slow_sum(terms), expected);
      std::ranges::shuffle(terms, random);
    }
  }
}

/// The sums beside each other have nothing to do with each other, and terms may be fewer than there is room for.
TEST(RoundedSums, SumsBesideEachOther)
{
  std::mt19937_64 random(5);
  std::array<Terms, 7> columns;
  RoundedSums<7> sums;
  for (int row = 0; row < 500; ++row)
  {
    std::array<double, 7> terms;
    for (std::size_t i = 0; i < terms.size(); ++i)
    {
      const int power = 100 * static_cast<int>(i) - 300;
      terms[i] = random_term(random, power, power + 3);
      columns[i].push_back(terms[i]);
    }
    sums.add(terms);
  }
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    double sum = 0;
    EXPECT_TRUE(sums.round(i, sum));
    EXPECT_EQ(sum, true_sum(columns[i])) << i;
  }
}
