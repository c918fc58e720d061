// SPDX-License-Identifier: BSD-3-Clause
#include "granular/numbers/number_print.h"
#include "granular/numbers/number_print_few.h"

#include "../support/decimals.h"
#include "../support/error_of.h"
#include "../support/exact_decimal.h"
#include "../support/hard_case.h"

#include <gtest/gtest.h>

#include <bit>
#include <cfloat>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <random>
#include <string>

namespace
{
using granular::most_number_chars;
using granular::NumberFormat;
using granular::parse_number_format;

constexpr int most_digits = 17;

/// In a buffer of exactly the size that may be written to, so that a sanitizer sees more.
template <typename Print>
std::string text_of(Print&& print)
{
  const std::unique_ptr<char[]> buffer(new char[most_number_chars]);
  const char* const end = print(buffer.get());
  return { static_cast<const char*>(buffer.get()), end };
}

std::string printed(double value, int digits)
{
  return text_of([&](char* to) { return granular::print_number(to, value, { digits }); });
}

std::string printed_exactly(double value, int digits)
{
  return text_of([&](char* to) { return granular::print_number(to, value, { digits, true }); });
}

std::string printed_integer(std::int64_t value)
{
  return text_of([&](char* to) { return granular::number_print::print_whole(to, value); });
}

std::string by_printf(double value, int digits)
{
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  return buffer;
}

std::string hexadecimal(double value)
{
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%a", value);
  return buffer;
}

/// Both signs, all numbers of digits.
void expect_as_printf(double value)
{
  for (const double each : { value, -value })
  {
    for (int digits = 1; digits <= most_digits; ++digits)
    {
      ASSERT_EQ(printed(each, digits), by_printf(each, digits))
        << digits << " digits of " << hexadecimal(each);
    }
  }
}

/// With the doubles beside it.
void expect_neighbours_as_printf(double value)
{
  const auto bits = std::bit_cast<std::uint64_t>(value);
  for (std::uint64_t near = bits < 3 ? 0 : bits - 3; near <= bits + 3; ++near)
  {
    expect_as_printf(std::bit_cast<double>(near));
  }
}

void expect_as_exact(double value)
{
  const ExactDecimal exact(value);
  for (int digits = 1; digits <= most_digits; ++digits)
  {
    ASSERT_EQ(printed(value, digits), exact.text(digits))
      << digits << " digits of " << hexadecimal(value);
  }
}

double random_double(std::mt19937_64& random)
{
  const auto value = std::bit_cast<double>(random());
  return std::isfinite(value) ? value : 0.1;
}

/// Few bits, or few decimal digits, or of a size as in dumps; of any kind.
double usual_double(std::mt19937_64& random)
{
  const double unit = static_cast<double>(random() >> 11) * 0x1p-53;
  const int size = static_cast<int>(random() % 24);
  switch (random() % 5)
  {
    case 0:
      return 2 * unit - 1;
    case 1:
      return (2 * unit - 1) * std::pow(10.0, size - 12);
    case 2:
      return static_cast<double>(static_cast<std::int64_t>(random()) >> (random() % 64));
    case 3: // ties for some number of digits
      return std::ldexp(static_cast<double>(random() >> (11 + random() % 53)), size - 16);
    default: // as if read from a text
      return std::strtod(
        by_printf((2 * unit - 1) * std::pow(10.0, size - 8), static_cast<int>(1 + random() % 17))
          .c_str(),
        nullptr);
  }
}
}

// ---- formats -----------------------------------------------------------------------------------

TEST(NumberFormat, FromText)
{
  EXPECT_EQ(parse_number_format("%g"), NumberFormat{ 6 });
  EXPECT_EQ(parse_number_format("%g"), NumberFormat{});
  EXPECT_EQ(parse_number_format("shortest"), NumberFormat{ 0 });
  EXPECT_EQ(parse_number_format("Automatic"), granular::automatic_numbers);
  for (const char* const text : { "Automatic", "shortest", "%g", "%.9g" })
  {
    EXPECT_EQ(granular::to_text(parse_number_format(text)), text);
  }
  for (int digits = 1; digits <= most_digits; ++digits)
  {
    EXPECT_EQ(parse_number_format("%." + std::to_string(digits) + "g"), NumberFormat{ digits });
  }
}

TEST(NumberFormat, RefusesOthers)
{
  for (const char* text : { "", "g", "%", "%.g", "%.0g", "%.00g", "%.06g", "%.18g",
         "%.99999999999g", "%.-1g", "%.+6g", "%6g", "%.6e", "%.6f", "%f", "%G", "%.6G", "%.6g ",
         " %g", "Shortest", "automatic", "%.6gg", "%.1.g", "%lg" })
  {
    EXPECT_EQ(error_of<granular::FormatError>([&] { parse_number_format(text); }),
      "expected a number format of Automatic, %g, %.Ng with N from 1 to 17, or shortest, got '" +
        std::string(text) + "'");
  }
}

// ---- real numbers ------------------------------------------------------------------------------

TEST(PrintNumber, ByHand)
{
  EXPECT_EQ(printed(0, 6), "0");
  EXPECT_EQ(printed(-0.0, 6), "-0");
  EXPECT_EQ(printed(1, 6), "1");
  EXPECT_EQ(printed(-0.5, 6), "-0.5");
  EXPECT_EQ(printed(0.0001, 6), "0.0001");
  EXPECT_EQ(printed(0.00001, 6), "1e-05");
  EXPECT_EQ(printed(123456, 6), "123456");
  EXPECT_EQ(printed(1234567, 6), "1.23457e+06");
  EXPECT_EQ(printed(120000, 6), "120000");
  EXPECT_EQ(printed(9.9999949, 6), "9.99999");
  EXPECT_EQ(printed(9.999995, 6), "10"); // the double is above
  EXPECT_EQ(printed(0.000099999951, 6), "0.0001");
  EXPECT_EQ(printed(999999.5, 6), "1e+06");
  EXPECT_EQ(printed(1234565, 6), "1.23456e+06"); // a tie: to even
  EXPECT_EQ(printed(1234575, 6), "1.23458e+06");
  EXPECT_EQ(printed(0.1, 17), "0.10000000000000001");
  EXPECT_EQ(printed(12345678901234568, 17), "12345678901234568");
  EXPECT_EQ(printed(-1.7976931348623157e308, 17), "-1.7976931348623157e+308");
  EXPECT_EQ(printed(-4.9406564584124654e-324, 17), "-4.9406564584124654e-324");
  EXPECT_EQ(printed(DBL_MAX, 1), "2e+308");
}

TEST(PrintNumber, NanAndInfinity)
{
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int digits = 0; digits <= most_digits; ++digits)
  {
    EXPECT_EQ(printed(infinity, digits), "inf");
    EXPECT_EQ(printed(-infinity, digits), "-inf");
    EXPECT_EQ(printed(nan, digits), "nan");
    EXPECT_EQ(printed(std::copysign(nan, -1), digits), "-nan");
    EXPECT_EQ(printed(std::bit_cast<double>(0x7ff0000000000001), digits), "nan"); // signalling
  }
}

TEST(PrintNumber, PowersOfTenAndTwo)
{
  for (int power = -324; power <= 308 && !::testing::Test::HasFatalFailure(); ++power)
  {
    expect_neighbours_as_printf(std::strtod(("1e" + std::to_string(power)).c_str(), nullptr));
  }
  for (int power = -1074; power <= 1023 && !::testing::Test::HasFatalFailure(); ++power)
  {
    expect_neighbours_as_printf(std::ldexp(1.0, power));
  }
}

TEST(PrintNumber, EndsOfTheRange)
{
  for (const double value : { 0.0, DBL_TRUE_MIN, DBL_MIN, 0x1p-963, 1e-290, 1e-292 })
  {
    expect_neighbours_as_printf(value);
  }
  expect_as_printf(DBL_MAX);
  expect_as_printf(std::nextafter(DBL_MAX, 0));
}

// Next to 10^N, 10^N - 1/2 and d.ddd5: digits carry, and the form may change.
TEST(PrintNumber, Carries)
{
  for (int power = 0; power <= 17 && !::testing::Test::HasFatalFailure(); ++power)
  {
    const double ten = std::pow(10.0, power);
    expect_neighbours_as_printf(ten - 0.5);
    for (int below = 1; below <= 10; ++below)
    {
      expect_neighbours_as_printf(ten - below);
      expect_neighbours_as_printf(ten + below);
    }
  }
  for (int nines = 1; nines <= 17 && !::testing::Test::HasFatalFailure(); ++nines)
  {
    for (int power = -12; power <= 20; ++power)
    {
      const std::string text =
        "9." + std::string(static_cast<std::size_t>(nines - 1), '9') + "5e" + std::to_string(power);
      expect_neighbours_as_printf(std::strtod(text.c_str(), nullptr));
    }
  }
}

// (k + 1/2) * 10^power, k of N digits, where a double holds that exactly: odd * 5^power * 2^(power - 1).
TEST(PrintNumber, Ties)
{
  std::mt19937_64 random(17);
  std::int64_t ties = 0;
  for (int digits = 1; digits <= most_digits; ++digits)
  {
    double five = 1;
    for (int power = 0; power <= 22; ++power, five *= 5)
    {
      for (int i = 0; i < 100; ++i)
      {
        const double k = std::pow(10.0, digits - 1) *
          (1 + 9 * std::ldexp(static_cast<double>(random() >> 11), -53));
        const double multiple = (2 * std::floor(k) + 1) * five;
        const double quotient = 2 * std::floor(k / five) + 1; // odd, and so is 5^power times it
        if (multiple < 0x1p53)
        {
          ++ties;
          expect_as_printf(std::ldexp(multiple, power - 1));
          expect_as_exact(std::ldexp(multiple, power - 1));
        }
        if (quotient < 0x1p53 && quotient >= 3)
        {
          ++ties;
          expect_as_printf(std::ldexp(quotient, -power - 1));
          expect_as_exact(std::ldexp(quotient, -power - 1));
        }
        ASSERT_FALSE(::testing::Test::HasFatalFailure());
      }
    }
  }
  EXPECT_GT(ties, 20'000);
}

// Closer to a half of the last digit than 64 bits of a power of ten tell, found by continued fractions.
TEST(PrintNumber, NearTies)
{
  constexpr double values[] = {
    // clang-format off
    0x12e5f5dfa4fe9dp-338, 0x1e3cbc9907fdc8p-342, 0x1d1c26db7d0daep+598, 0x1754e31cd072dap+952,
    0x1afcef51f0fb5fp+211, 0x1d7c38a1814b9ap+735, 0x17d93193f78fc6p+535, 0x1cd5bee57763e6p-294,
    0x1c0794d9d40e96p-354, 0x127b2e4f210075p-824, 0x16ad8d72c5fe56p-340, 0x1cb857997b78cep-531,
    0x17d93193f78fc6p+534, 0x16c309024bab4bp+237, 0x1de2f4249c3fcbp+678, 0x12d6b183fe4b55p+254,
    0x1526be9c22eb17p+577, 0x127b2e4f210075p-825, 0x170105df3d47cbp+99, 0x10492a4a8a37fdp-752,
    0x1592f9932c06bdp-344, 0x12405b773fbdf3p-144, 0x157eb8ad52a5c9p+131, 0x19e6c44532c272p-972,
    0x17e1e0f1c7a4acp+363, 0x1dda592e398dd7p+366, 0x1d657059dc79aap+726, 0x170105df3d47cbp+98,
    0x17e1e0f1c7a4acp+362, 0x125818c7294f27p-741, 0x131e0cf0b3e774p-456, 0x17e5902ce0e151p-453,
    0x1e597c0b94b7aep+401, 0x10f73be1dff9adp+709, 0x12fcbc91078fefp-169, 0x1c57a7c6f5a9f0p+324,
    0x1c569e968e0944p+376, 0x1540f6f0ea86f3p+378, 0x1c569e968e0944p+375, 0x1397d3c9745d2fp-442,
    0x1ff5a70d3d2fefp-780, 0x16ce94febdc7a5p+147, 0x19ab8261990292p+710, 0x1aa65b58639e69p-962,
    0x1db65273dc9eb2p+724, 0x1fc575867314eep-385, 0x167cf7596968d4p+843, 0x1c1c352fc3c309p+846,
    0x15f2df5e675a0fp-507, 0x1acc46749dccfep-920, 0x1f7d6721f7f144p+701, 0x1fc6c26f899dd1p-1001,
    0x18bf7e7fa6f02ap-251, 0x1d0fcbf97f8d11p-454, 0x1011f2d73116f4p+486, 0x14166f8cfd5cb1p+489,
    0x1491daad0ba280p+479, 0x1a999ddec72acap+548, 0x183010aba78a54p+915, 0x1e3c14d6916ce9p+918,
    0x13de005bd620dfp+164, 0x17c0747bd76fa1p-866, 0x13de005bd620dfp+163, 0x159a2783ce70abp-381,
    0x1348bd023ae858p+484, 0x181aec42c9a26ep+487,
    // clang-format on
  };
  for (const double value : values)
  {
    expect_neighbours_as_printf(value);
    expect_as_exact(value);
  }
}

// GRANULAR_NUMBERS=50000000 build/core-only/tests/bin/test_number_print
TEST(PrintNumber, EqualsPrintfForAnyBits)
{
  HardCase hard("numbers, written",
    "%.1g to %.17g of doubles of any bits: other bytes than those of printf", "words", 0);
  std::mt19937_64 random(1);
  const std::int64_t count = numbers_to_try(200'000);
  for (std::int64_t i = 0; i < count; ++i)
  {
    const double value = random_double(random);
    const int digits = 1 + static_cast<int>(i % most_digits);
    hard.add(printed(value, digits) == by_printf(value, digits) ? 0 : 1);
    ASSERT_EQ(printed(value, digits), by_printf(value, digits)) << hexadecimal(value);
  }
}

TEST(PrintNumber, EqualsPrintfForUsualNumbers)
{
  std::mt19937_64 random(2);
  const std::int64_t count = numbers_to_try(200'000);
  for (std::int64_t i = 0; i < count; ++i)
  {
    const double value = usual_double(random);
    const int digits = i % 2 == 0 ? 6 : 1 + static_cast<int>(i / 2 % most_digits);
    ASSERT_EQ(printed(value, digits), by_printf(value, digits)) << hexadecimal(value);
  }
}

// ---- the shortest number -----------------------------------------------------------------------

TEST(PrintShortest, ByHand)
{
  EXPECT_EQ(printed(0, 0), "0");
  EXPECT_EQ(printed(-0.0, 0), "-0");
  EXPECT_EQ(printed(0.1, 0), "0.1");
  EXPECT_EQ(printed(-0.470467, 0), "-0.470467");
  EXPECT_EQ(printed(0.1 + 0.2, 0), "0.30000000000000004");
  EXPECT_EQ(printed(100000, 0), "1e+05");
  EXPECT_EQ(printed(120000, 0), "120000");
  EXPECT_EQ(printed(0.001, 0), "0.001");
  EXPECT_EQ(printed(0.0001, 0), "1e-04");
  EXPECT_EQ(printed(0.00012, 0), "0.00012");
  EXPECT_EQ(printed(DBL_TRUE_MIN, 0), "5e-324");
  EXPECT_EQ(printed(DBL_MAX, 0), "1.7976931348623157e+308");
}

void expect_shortest(double value)
{
  const std::string text = printed(value, 0);
  const double read = std::strtod(text.c_str(), nullptr);
  ASSERT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(value)) << text;
  char chars[64];
  const auto [end, error] = std::to_chars(chars, chars + sizeof chars, value);
  ASSERT_EQ(error, std::errc{});
  ASSERT_EQ(text, std::string(chars, end)) << hexadecimal(value);
  for (int digits = 1; digits <= most_digits; ++digits)
  {
    const std::string longer = by_printf(value, digits);
    if (std::strtod(longer.c_str(), nullptr) == value)
    {
      ASSERT_LE(text.size(), longer.size()) << longer;
      break;
    }
  }
}

TEST(PrintShortest, ReadsBackAndIsNeverLonger)
{
  for (int power = -324; power <= 308; ++power)
  {
    for (const char* mantissa : { "1", "1.2", "9.99999", "1.23456789012345", "1.2345678901234567" })
    {
      const double value = std::strtod((mantissa + ("e" + std::to_string(power))).c_str(), nullptr);
      expect_shortest(value);
      expect_shortest(-value);
      ASSERT_FALSE(::testing::Test::HasFatalFailure());
    }
  }
  // the double below a power of two is half as far away
  for (int power = -1074; power <= 1023; ++power)
  {
    const auto bits = std::bit_cast<std::uint64_t>(std::ldexp(1.0, power));
    for (std::uint64_t near = bits < 3 ? 1 : bits - 2; near <= bits + 2; ++near)
    {
      expect_shortest(std::bit_cast<double>(near));
      ASSERT_FALSE(::testing::Test::HasFatalFailure());
    }
  }
  HardCase hard("numbers, written",
    "shortest: words that do not read back, or that a shorter one reads back as", "words", 0);
  std::mt19937_64 random(4);
  const std::int64_t count = numbers_to_try(200'000) / 5;
  for (std::int64_t i = 0; i < count && !::testing::Test::HasFatalFailure(); ++i)
  {
    expect_shortest(i % 4 == 0 ? random_double(random) : usual_double(random));
    hard.add(::testing::Test::HasFatalFailure() ? 1 : 0);
  }
}

// ---- so many digits, and more where they are needed ---------------------------------------------

TEST(PrintExact, ByHand)
{
  EXPECT_EQ(printed_exactly(0.1, 6), "0.1");
  EXPECT_EQ(printed_exactly(0.1234567, 6), "0.1234567");
  EXPECT_EQ(printed_exactly(100000, 6), "100000");
  EXPECT_EQ(printed_exactly(1000000, 6), "1e+06");
  EXPECT_EQ(printed_exactly(1234567, 6), "1234567");
  EXPECT_EQ(printed_exactly(-0.0, 6), "-0");
  EXPECT_EQ(printed_exactly(0.1, 17), "0.10000000000000001");
  EXPECT_EQ(printed_exactly(0.1 + 0.2, 6), "0.30000000000000004");
  EXPECT_EQ(printed_exactly(0.1 + 0.2, 16), "0.30000000000000004");
  EXPECT_EQ(printed_exactly(DBL_TRUE_MIN, 6), "4.94066e-324");
  EXPECT_EQ(printed_exactly(1e300, 6), "1e+300");
}

/// The number that printf prints so has the same text again; any other one reads back.
void expect_exact(double value, int digits)
{
  const std::string text = by_printf(value, digits);
  const double kept = std::strtod(text.c_str(), nullptr);
  ASSERT_EQ(std::bit_cast<std::uint64_t>(granular::as_printed(value, { digits })),
    std::bit_cast<std::uint64_t>(kept))
    << text;
  // with 16 digits a number may have a neighbour that is printed alike
  if (std::isfinite(kept) && by_printf(kept, digits) == text)
  {
    ASSERT_EQ(printed_exactly(kept, digits), text) << hexadecimal(kept) << ' ' << digits;
  }
  const std::string whole = printed_exactly(value, digits);
  const double read = std::strtod(whole.c_str(), nullptr);
  ASSERT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(value)) << whole;
}

TEST(PrintExact, KeepsTheDigitsOfATextAndReadsBack)
{
  std::mt19937_64 random(6);
  const std::int64_t count = numbers_to_try(200'000);
  for (std::int64_t i = 0; i < count && !::testing::Test::HasFatalFailure(); ++i)
  {
    const double value = i % 2 == 0 ? random_double(random) : usual_double(random);
    if (std::isfinite(value))
    {
      expect_exact(value, 1 + static_cast<int>(i / 2 % most_digits));
    }
  }
  for (int power = -324; power <= 308 && !::testing::Test::HasFatalFailure(); ++power)
  {
    for (const char* mantissa : { "1", "1.2", "9.99999", "1.23456789012345", "1.2345678901234567" })
    {
      for (int digits = 1; digits <= most_digits; ++digits)
      {
        expect_exact(
          std::strtod((mantissa + ("e" + std::to_string(power))).c_str(), nullptr), digits);
      }
    }
  }
}

// ---- integers ----------------------------------------------------------------------------------

TEST(PrintInteger, PowersOfTenAndTheEnds)
{
  std::int64_t power = 1;
  for (int k = 0; k <= 18; ++k)
  {
    for (const std::int64_t value : { power - 1, power, power + 1 })
    {
      EXPECT_EQ(printed_integer(value), std::to_string(value));
      EXPECT_EQ(printed_integer(-value), std::to_string(-value));
    }
    power *= k < 18 ? 10 : 1;
  }
  EXPECT_EQ(printed_integer(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
  EXPECT_EQ(printed_integer(std::numeric_limits<std::int64_t>::max()), "9223372036854775807");
}

TEST(PrintInteger, SmallAndRandom)
{
  for (std::int64_t value = -11'000; value <= 110'000; ++value)
  {
    ASSERT_EQ(printed_integer(value), std::to_string(value));
  }
  std::mt19937_64 random(5);
  for (int i = 0; i < 200'000; ++i)
  {
    const auto value = static_cast<std::int64_t>(random()) >> (random() % 64);
    ASSERT_EQ(printed_integer(value), std::to_string(value));
  }
}
