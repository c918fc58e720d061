// SPDX-License-Identifier: BSD-3-Clause
// Times of steps against strtod of the exact product, multiplied digit by digit as at school.
#include "granular/numbers/number.h"

#include "../support/hard_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

using granular::StepClock;

namespace
{
/// A decimal number as its digits and a power of ten.
struct Decimal
{
  std::string digits;
  int power = 0;
};

/// The shortest of printf's numbers that reads back.
Decimal shortest(double value)
{
  char text[64];
  int digits = 1;
  do
  {
    std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
  } while (std::strtod(text, nullptr) != value && digits++ < 17);
  Decimal decimal;
  const std::string all = text;
  const std::size_t e = all.find('e');
  decimal.digits = all.substr(0, 1) + (e > 2 ? all.substr(2, e - 2) : "");
  decimal.power = std::atoi(all.c_str() + e + 1) - static_cast<int>(decimal.digits.size()) + 1;
  return decimal;
}

/// The product of two natural numbers, digit by digit.
std::string product(const std::string& a, const std::string& b)
{
  std::vector<int> sums(a.size() + b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      sums[i + j + 1] += (a[i] - '0') * (b[j] - '0');
    }
  }
  std::string digits(sums.size(), '0');
  int carry = 0;
  for (std::size_t i = sums.size(); i-- > 0;)
  {
    carry += sums[i];
    digits[i] = static_cast<char>('0' + carry % 10);
    carry /= 10;
  }
  return digits;
}

double expected(std::int64_t step, double size)
{
  const Decimal decimal = shortest(size);
  const std::string number = std::to_string(step);
  const bool negative = number[0] == '-';
  const std::string text = (negative ? "-" : "") +
    product(negative ? number.substr(1) : number, decimal.digits) + "e" +
    std::to_string(decimal.power);
  return std::strtod(text.c_str(), nullptr);
}

constexpr std::int64_t largest = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t smallest = std::numeric_limits<std::int64_t>::min();
}

TEST(StepClock, TimesAreWhatAPersonWrites)
{
  const StepClock clock(1e-5);
  EXPECT_EQ(clock.time(3), 3e-05);
  EXPECT_EQ(clock.time(7), 7e-05);
  EXPECT_EQ(clock.time(1000), 0.01);
  EXPECT_EQ(clock.time(-3), -3e-05);
  EXPECT_EQ(clock.time(0), 0);
  EXPECT_FALSE(std::signbit(clock.time(0)));
  EXPECT_EQ(StepClock(2e-5).time(3000), 0.06);
  EXPECT_EQ(StepClock(1).time(largest), 0x1p63);
  EXPECT_EQ(StepClock(1).time(smallest), -0x1p63);
}

TEST(StepClock, SizesThatPeopleUse)
{
  for (const double size : { 1e-5, 2e-5, 5e-6, 2.5e-6, 1e-7, 0.005, 0.1, 1.1, 3., 1e3, 1e22, 1e23 })
  {
    const StepClock clock(size);
    for (std::int64_t step = 0; step < 5000; ++step)
    {
      ASSERT_EQ(clock.time(step), expected(step, size)) << step << " x " << size;
    }
  }
}

/// Sizes of any magnitude and of 1 to 17 digits, steps of any number of bits.
TEST(StepClock, AnySizesAndSteps)
{
  HardCase hard("times",
    "sizes of 1 to 17 digits and any magnitude, steps of up to 63 bits: not the nearest double",
    "times", 0);
  std::mt19937_64 random(7);
  for (int turn = 0; turn < 100000; ++turn)
  {
    char text[64];
    const int power = static_cast<int>(random() % 632) - 324;
    std::snprintf(text, sizeof text, "%llue%d",
      static_cast<unsigned long long>(1 + (random() >> (7 + random() % 57))), power - 10);
    const double size = std::strtod(text, nullptr);
    const auto step = static_cast<std::int64_t>(random()) >> (random() % 64);
    if (size > 0 && std::isfinite(size))
    {
      const double time = StepClock(size).time(step);
      hard.add(time == expected(step, size) ? 0 : 1);
      ASSERT_EQ(time, expected(step, size)) << step << " x " << text;
    }
  }
}

TEST(StepClock, TheLargestAndTheSmallestNumbers)
{
  const double sizes[] = { std::numeric_limits<double>::denorm_min(),
    std::numeric_limits<double>::min(), std::numeric_limits<double>::max(), 0x1p-1, 0x1p62 };
  for (const double size : sizes)
  {
    for (const std::int64_t step : { smallest, smallest + 1, std::int64_t{ -1 }, std::int64_t{ 1 },
           std::int64_t{ 2 }, largest - 1, largest })
    {
      EXPECT_EQ(StepClock(size).time(step), expected(step, size)) << step << " x " << size;
    }
  }
  EXPECT_EQ(StepClock(1e300).time(1000000000), HUGE_VAL);
}
