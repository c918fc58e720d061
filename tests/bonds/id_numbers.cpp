// SPDX-License-Identifier: BSD-3-Clause
#include "packing.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

namespace
{
using granular::id_to_number;
using granular::number_to_id;

std::uint64_t bits_of(double number)
{
  return std::bit_cast<std::uint64_t>(number);
}

std::int64_t as_id(std::uint64_t bits)
{
  return std::bit_cast<std::int64_t>(bits);
}

/// Patterns next to all places where something changes: each is tried as an id and as a double.
std::set<std::uint64_t> hard_patterns()
{
  std::set<std::uint64_t> patterns;
  const auto add_around = [&](std::uint64_t middle)
  {
    for (std::uint64_t k = 0; k < 7; ++k)
    {
      patterns.insert(middle + k - 3);
    }
  };
  for (int power = 0; power < 64; ++power)
  {
    add_around(std::uint64_t{ 1 } << power);
    add_around(-(std::uint64_t{ 1 } << power));
  }
  for (int power = -1; power <= 64; ++power)
  {
    const double value = power < 0 ? 0 : std::bit_cast<double>(std::uint64_t(1023 + power) << 52);
    for (const double next : { value, value + 1, value - 1, value + 0.5, value * 1.5 })
    {
      add_around(bits_of(next));
      add_around(bits_of(-next));
    }
  }
  for (const std::uint64_t border : { 0x7ff0000000000000U, 0xfff0000000000000U, 0x7ff8000000000000U,
         0xfff8000000000000U, 0x0010000000000000U, 0x8010000000000000U })
  {
    add_around(border);
  }
  return patterns;
}

TEST(IdNumbers, small_ones_are_values)
{
  const std::int64_t limit = std::int64_t{ 1 } << 53;
  for (const std::int64_t id : { std::int64_t{ 0 }, std::int64_t{ 1 }, std::int64_t{ -1 },
         std::int64_t{ 4294967297 }, limit - 1, limit, -limit })
  {
    EXPECT_EQ(bits_of(id_to_number(id)), bits_of(static_cast<double>(id)));
  }
}

/// By hand: 4607182418800017408 is 0x3ff0000000000000, the bits of 1.
TEST(IdNumbers, large_ones_are_bits)
{
  EXPECT_EQ(bits_of(id_to_number(4607182418800017408)), 1U);
  EXPECT_EQ(bits_of(id_to_number(as_id(bits_of(-2.0)))), bits_of(0) - 2);
  EXPECT_EQ(bits_of(id_to_number(as_id(bits_of(0x1p53)))), std::uint64_t{ 1 } << 53);
  EXPECT_EQ(bits_of(id_to_number(as_id(bits_of(0x1p54)))), bits_of(0x1p54));
  EXPECT_EQ(bits_of(id_to_number(as_id(bits_of(1.5)))), bits_of(1.5));
  EXPECT_EQ(bits_of(id_to_number(std::int64_t{ 1 } << 62)), 2U); // the bits of 2
  EXPECT_EQ(bits_of(id_to_number((std::int64_t{ 1 } << 53) + 1)), (std::uint64_t{ 1 } << 53) + 1);
  EXPECT_EQ(bits_of(id_to_number(as_id(std::uint64_t{ 1 } << 63))), bits_of(-0.0));
}

/// One to one on both sides: what comes back is what was sent, so no two can be the same.
void expect_both_ways(std::uint64_t pattern)
{
  const std::int64_t id = as_id(pattern);
  ASSERT_EQ(number_to_id(id_to_number(id)), id) << std::hex << pattern;
  const auto number = std::bit_cast<double>(pattern);
  ASSERT_EQ(bits_of(id_to_number(number_to_id(number))), pattern) << std::hex << pattern;
}

TEST(IdNumbers, every_border_comes_back)
{
  const std::set<std::uint64_t> patterns = hard_patterns();
  EXPECT_GT(patterns.size(), 1500U);
  std::set<std::uint64_t> sent;
  for (const std::uint64_t pattern : patterns)
  {
    expect_both_ways(pattern);
    sent.insert(bits_of(id_to_number(as_id(pattern))));
  }
  EXPECT_EQ(sent.size(), patterns.size());
}

TEST(IdNumbers, any_pattern_comes_back)
{
  std::mt19937_64 random(4);
  for (int i = 0; i < 1'000'000; ++i)
  {
    const std::uint64_t pattern = random();
    expect_both_ways(pattern);
    expect_both_ways(pattern >> (i % 64));
    const auto small = static_cast<double>(as_id(pattern) >> (i % 52 + 8));
    expect_both_ways(bits_of(small)); // the ones that change places
  }
}

TEST(IdNumbers, known_when_compiled)
{
  static_assert(number_to_id(id_to_number(4607182418800017408)) == 4607182418800017408);
  static_assert(id_to_number(-12) == -12.0);
}
}
