// SPDX-License-Identifier: BSD-3-Clause
// The sum of a product that rounds once, by integers, is the processor's.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include <immintrin.h>

#define fma fma_of_library
#include "../../core/granular/common/fma_windows.cpp"
#undef fma

#include <gtest/gtest.h>

namespace
{
bool is_same(double a, double b)
{
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}

TEST(Fma, OfTheLibraryIsTheOneThatIsCalled)
{
  const volatile double a =
    0x1.2832adec3948bp+11; // read when it runs; that of MinGW gives ...bcebc6ad5p-51
  const volatile double b = -0x1.169900f80143ep-7;
  EXPECT_EQ(std::fma(a, b, -(a * b)), -0x1.c33bd2bc6ad5p-51);
}

TEST(Fma, RoundsOnceWithoutTheInstruction)
{
  if (!__builtin_cpu_supports("fma"))
  {
    GTEST_SKIP() << "a processor with the instruction is needed, to compare with";
  }
  // exponents of the factors and of the term around these, from numbers that overflow to those that vanish
  constexpr struct
  {
    std::uint64_t factors, term, spread;
  } scales[] = { { 1023, 1023, 60 }, { 1023, 1023, 3 }, { 500, 0, 40 }, { 486, 1, 12 },
    { 1500, 2040, 6 }, { 1023, 900, 200 } };
  std::mt19937_64 random(1);
  const auto made = [&](std::uint64_t exponent, std::uint64_t spread)
  {
    const std::uint64_t bits = random();
    const std::uint64_t blank =
      (std::uint64_t{ 1 } << random() % 52) - 1; // fewer bits, so that ties come
    return std::bit_cast<double>(
      ((bits & 0x800f'ffff'ffff'ffff) & ~blank) | (exponent + random() % spread) << 52);
  };
  for (const auto& scale : scales)
  {
    for (int i = 0; i < 300'000; ++i)
    {
      const double a = made(scale.factors, scale.spread);
      const double b = made(scale.factors, scale.spread);
      const double c = i % 3 == 0 ? std::nextafter(-a * b, 0) : made(scale.term, scale.spread);
      if (a != 0 && b != 0 && std::isfinite(c))
      {
        ASSERT_TRUE(is_same(add_product(a, b, c), by_instruction(a, b, c)))
          << std::hexfloat << a << " " << b << " " << c;
      }
    }
  }
}
}
