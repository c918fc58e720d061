// SPDX-License-Identifier: BSD-3-Clause
#include "granular/geometry/reproducible_sum.h"

#include "../support/big_sum.h"
#include "../support/hard_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

using namespace granular;

namespace
{
using Terms = SumScale::Terms;

constexpr double least = std::numeric_limits<double>::denorm_min();

std::vector<std::int64_t> sum_of(
  const SumScale& scale, const std::vector<Terms>& terms, Simd simd = best_simd())
{
  std::vector<std::int64_t> sums(scale.size());
  const std::vector<std::int64_t> cells(terms.size());
  scale.add(terms, cells.data(), sums.data(), simd);
  return sums;
}

Terms exact(const std::vector<Terms>& terms)
{
  Terms sums;
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    BigSum sum;
    for (const Terms& term : terms)
    {
      sum.add(term[i]);
    }
    sums[i] = sum.value();
  }
  return sums;
}

/// Ranges that hold any of these terms exactly.
SumScale scale_for(const std::vector<Terms>& terms)
{
  std::array<SumScale::Range, SumScale::lanes> ranges;
  for (std::size_t i = 0; i < ranges.size(); ++i)
  {
    double largest = 0;
    double smallest = std::numeric_limits<double>::max();
    for (const Terms& term : terms)
    {
      largest = std::max(largest, std::abs(term[i]));
      smallest = term[i] == 0 ? smallest : std::min(smallest, std::abs(term[i]));
    }
    if (largest > 0)
    {
      ranges[i] = { std::ilogb(largest) + 1, std::ilogb(smallest) - 52 };
    }
  }
  return SumScale(ranges, static_cast<std::int64_t>(terms.size()));
}

/// Each lane has terms of so many more binary orders than the one before.
std::vector<Terms> make_terms(std::size_t count, int orders, unsigned seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::vector<Terms> terms(count);
  for (Terms& term : terms)
  {
    for (std::size_t i = 0; i < term.size(); ++i)
    {
      std::uniform_int_distribution<int> exponent(-orders * static_cast<int>(i), 0);
      term[i] = std::ldexp(mantissa(random), exponent(random));
    }
  }
  return terms;
}
}

TEST(ReproducibleSum, IsCorrectlyRoundedWhateverTheTermsAre)
{
  HardCase hard("sums",
    "terms over up to 980 binary orders, against large integers: not correctly rounded", "sums", 0);
  for (const int orders : { 0, 3, 10, 40, 140 })
  {
    for (const std::size_t count : { 1U, 2U, 3U, 100U, 5000U })
    {
      const std::vector<Terms> terms =
        make_terms(count, orders, static_cast<unsigned>(orders) + static_cast<unsigned>(count));
      const SumScale scale = scale_for(terms);
      const Terms values = scale.values(sum_of(scale, terms).data());
      hard.add(values == exact(terms) ? 0 : 1, SumScale::lanes);
      EXPECT_EQ(values, exact(terms))
        << orders << " orders, " << count << " terms, " << scale.levels() << " levels";
    }
  }
}

TEST(ReproducibleSum, IsTheSameForAnyOrderPartsAndInstructions)
{
  std::vector<Terms> terms = make_terms(3000, 12, 7);
  const SumScale scale = scale_for(terms);
  const std::vector<std::int64_t> sums = sum_of(scale, terms);
  const Terms values = scale.values(sums.data());
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 10; ++trial)
  {
    std::ranges::shuffle(terms, random);
    EXPECT_EQ(scale.values(sum_of(scale, terms).data()), values);
    const auto middle = terms.begin() + trial * 200;
    std::vector<std::int64_t> parts = sum_of(scale, { terms.begin(), middle });
    std::ranges::transform(
      parts, sum_of(scale, { middle, terms.end() }), parts.begin(), std::plus<>());
    EXPECT_EQ(parts, sums);
  }
  for (const Simd simd : granular::instruction_sets())
  {
    EXPECT_EQ(sum_of(scale, terms, simd), sums) << to_string(simd);
  }
}

TEST(ReproducibleSum, CancelsToTheLastBit)
{
  std::vector<Terms> terms = make_terms(1000, 30, 11);
  const std::size_t count = terms.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    Terms negative = terms[i];
    for (double& term : negative)
    {
      term = -term;
    }
    terms.push_back(negative);
  }
  const SumScale scale = scale_for(terms);
  EXPECT_EQ(scale.values(sum_of(scale, terms).data()), Terms{});
  terms.push_back({ 1e-12, 1e-12, 1e-30, -1e-30, 1e-40, 0x1p-200, -0x1p-200, 1e-60 });
  const SumScale wider = scale_for(terms);
  HardCase hard(
    "sums", "2000 terms that cancel, and 1e-12 to 1e-60 that remains: not what remains", "sums", 0);
  const Terms values = wider.values(sum_of(wider, terms).data());
  hard.add(values == terms.back() ? 0 : 1, SumScale::lanes);
  EXPECT_EQ(values, terms.back());
}

TEST(ReproducibleSum, RoundsTiesToEvenAndLooksBelowThem)
{
  const double one = 1;
  const double half = 0x1p-53; // of the last bit of 1
  const std::vector<std::pair<std::vector<double>, double>> cases = {
    { { one, half }, 1 },
    { { one, half, 0x1p-300 }, 1 + 0x1p-52 },
    { { one, half, -0x1p-300 }, 1 },
    { { 1 + 0x1p-52, half }, 1 + 0x1p-51 },
    { { 1 + 0x1p-52, half, -0x1p-300 }, 1 + 0x1p-52 },
    { { -one, -half, -0x1p-300 }, -1 - 0x1p-52 },
    { { 0x1p200, -0x1p200, 0x1p-300 }, 0x1p-300 },
    { { 0x1p200, 0x1p-300, -0x1p200 }, 0x1p-300 },
  };
  for (const auto& [numbers, sum] : cases)
  {
    std::vector<Terms> terms;
    for (const double number : numbers)
    {
      terms.push_back({ number, -number, number, 0, 0, 0, 0, number });
    }
    const SumScale scale = scale_for(terms);
    EXPECT_EQ(
      scale.values(sum_of(scale, terms).data()), (Terms{ sum, -sum, sum, 0, 0, 0, 0, sum }));
  }
}

TEST(ReproducibleSum, ReachesFromTheSmallestNumberThereIsToTheLargestTerm)
{
  const std::vector<Terms> terms = { { least, 0x1p899, -least, 3 * least, 0, 1, 0, 0 },
    { least, -0x1p899, 0x1p-1022, 0x1p899, 0, least, 0, 0 },
    { 5 * least, least, 0, -0x1p899, 0, -1, 0, 0 } };
  const SumScale scale = scale_for(terms);
  EXPECT_EQ(scale.values(sum_of(scale, terms).data()),
    (Terms{ 7 * least, least, 0x1p-1022 - least, 3 * least, 0, least, 0, 0 }));
}

TEST(ReproducibleSum, HoldsTheLargestSumOfAsManyTermsAsWereSaid)
{
  for (const std::int64_t terms : { 1, 1000, 1 << 20 })
  {
    const double term = std::nextafter(1, 0);
    std::array<SumScale::Range, SumScale::lanes> ranges;
    ranges.fill({ 0, -53 });
    const SumScale scale(ranges, terms);
    const std::vector<std::int64_t> sums = sum_of(scale,
      std::vector<Terms>(static_cast<std::size_t>(terms), { term, -term, term, 0, 0, 0, 0, term }));
    const double sum = static_cast<double>(terms) * term; // one rounding
    EXPECT_EQ(scale.values(sums.data()), (Terms{ sum, -sum, sum, 0, 0, 0, 0, sum }));
  }
}

TEST(ReproducibleSum, TermsBelowTheBottomAreRoundedOneByOne)
{
  std::array<SumScale::Range, SumScale::lanes> ranges;
  ranges.fill({ 1, -10 });
  const SumScale scale(ranges, 4);
  const int bits = 59; // of a level: 62 less those that count the terms
  const double unit = std::ldexp(1.0, 1 - std::min(bits, 50));
  const std::vector<Terms> terms(3, { unit, unit * 0.75, unit * 0.25, -unit * 0.75, 0, 0, 0, 0 });
  EXPECT_EQ(scale.values(sum_of(scale, terms).data()),
    (Terms{ 3 * unit, 3 * unit, 0, -3 * unit, 0, 0, 0, 0 }));
}
