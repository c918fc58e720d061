// SPDX-License-Identifier: BSD-3-Clause
#include "granular/numbers/number.h"

#include "../support/decimals.h"
#include "../support/hard_case.h"
#include "../support/quad.h"
#include "granular/numbers/decimal.h"

#include <gtest/gtest.h>

#include <bit>
#include <cfloat>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

namespace
{
using granular::parse_double;
using granular::parse_int64;

constexpr double infinity = std::numeric_limits<double>::infinity();

std::uint64_t bits(double value)
{
  return std::bit_cast<std::uint64_t>(value);
}

/// The value of a word, in a buffer of exactly its size so that a sanitizer sees every read past
/// it. Fails the test if it is refused.
double value_of(std::string_view word)
{
  const std::unique_ptr<char[]> copy(new char[word.size()]);
  word.copy(copy.get(), word.size());
  double value = -12345;
  const granular::ParseResult result = parse_double(copy.get(), copy.get() + word.size(), value);
  EXPECT_EQ(result.ec, std::errc{}) << word;
  EXPECT_EQ(result.ptr, copy.get() + word.size()) << word;
  return value;
}

bool is_refused(std::string_view word)
{
  double value = -12345;
  const granular::ParseResult result = parse_double(word.data(), word.data() + word.size(), value);
  EXPECT_EQ(value, -12345) << "touched although refused: " << word;
  return !result && result.ec == std::errc::invalid_argument && result.ptr >= word.data() &&
    result.ptr <= word.data() + word.size();
}

bool parse_integer(std::string_view word, std::int64_t& value)
{
  return static_cast<bool>(parse_int64(word.data(), word.data() + word.size(), value));
}

std::int64_t integer_of(std::string_view word)
{
  std::int64_t value = -12345;
  EXPECT_TRUE(parse_integer(word, value)) << word;
  return value;
}

bool integer_is_refused(std::string_view word)
{
  std::int64_t value = -12345;
  const bool refused = !parse_integer(word, value);
  EXPECT_EQ(value, -12345) << "touched although refused: " << word;
  return refused;
}

void expect_as_strtod(const std::string& word, const char* kind)
{
  double value = 0;
  const auto result = parse_double(word.data(), word.data() + word.size(), value);
  char* end = nullptr;
  const double expected = std::strtod(word.c_str(), &end);
  ASSERT_EQ(end, word.c_str() + word.size()) << "strtod: " << word;
  ASSERT_TRUE(result && bits(value) == bits(expected))
    << word << " (" << kind << "): expected " << expected << ", got " << value;
}
}

// ---- doubles -----------------------------------------------------------------------------------

// GRANULAR_NUMBERS=50000000 build/core-only/tests/bin/test_number --gtest_filter='*Strtod*'
TEST(ParseDouble, EqualsStrtodBitForBit)
{
  HardCase hard("numbers, read",
    "words of up to 800 digits, many next to the middle of two doubles: not the nearest double",
    "words", 0);
  Decimals decimals(20240607);
  const std::int64_t count = numbers_to_try(400'000);
  for (std::int64_t i = 0; i < count && !::testing::Test::HasFatalFailure(); ++i)
  {
    const std::string& word = decimals.next();
    expect_as_strtod(word, decimals.kind());
    hard.add(::testing::Test::HasFatalFailure() ? 1 : 0);
  }
}

TEST(ParseDouble, HardCasesAsTheCompilerReadsThem)
{
#define WORD(text) \
  {                \
#text, text    \
  }
  constexpr struct
  {
    const char* word;
    double value;
  } cases[] = {
    // clang-format off
    WORD(0.1), WORD(1e23), WORD(8.41e21), WORD(9.5367431640625e-7), WORD(1e22), WORD(1e-23),
    WORD(2.2250738585072011e-308), WORD(2.2250738585072012e-308), WORD(2.2250738585072014e-308),
    WORD(1.7976931348623157e308), WORD(1.7976931348623158e308), WORD(4.9406564584124654e-324),
    WORD(2.4703282292062328e-324), WORD(9007199254740991), WORD(9007199254740992.),
    WORD(9007199254740993.), WORD(9007199254740993.0000000000000000000000000000000000000000001),
    WORD(9007199254740995.), WORD(18446744073709551615.), WORD(0.30000000000000004),
    WORD(6.631236846766476e-316), WORD(3.518437208883201171875e13), WORD(62.5364939768271845828),
    WORD(8.10109172351e-10), WORD(1.50000000000000011102230246251565), WORD(5e-324),
    WORD(1090544144181609348671888949248.), WORD(1090544144181609348835077142190.),
    WORD(0.000000000000000000000000000000000000000000000000000000000000000000000000000000001e81),
    WORD(10000000000000000000000000000000000000000000000000000000000000000000000000000000000e-83),
    // clang-format on
  };
#undef WORD
  for (const auto& hard : cases)
  {
    EXPECT_EQ(bits(value_of(hard.word)), bits(hard.value)) << hard.word;
  }
}

TEST(ParseDouble, TieOfTheLargestDoubleAndTheNextPowerOfTwo)
{
  // 2^1024 - 2^970, midway between the largest double and 2^1024: to even, which is infinity
  const std::string tie =
    "17976931348623158079372897140530341507993413271003782693617377898044496829276475094664901797"
    "75872070963302864166928879109465555478519404026306574886715058206819089020007083836762738548"
    "45817711531764475730270069855571366959622842914819860834936475292719074168444365510704342711"
    "559699508093042880177904174497792";
  std::string below = tie;
  --below.back(); // a 2
  EXPECT_EQ(value_of(tie), infinity);
  EXPECT_EQ(value_of("-" + tie), -infinity);
  EXPECT_EQ(value_of(below), DBL_MAX);
  EXPECT_EQ(value_of(below + ".9999"), DBL_MAX);
  EXPECT_EQ(value_of(tie + ".0001"), infinity);
}

TEST(ParseDouble, TooLargeBecomesInfinityAndTooSmallZero)
{
  const std::string zeros(2000, '0');
  EXPECT_EQ(value_of("1e309"), infinity);
  EXPECT_EQ(value_of("-1e309"), -infinity);
  EXPECT_EQ(value_of("1.8e308"), infinity);
  EXPECT_EQ(value_of("1e99999999999999999999"), infinity);
  EXPECT_EQ(value_of("1e+99999999999999999999"), infinity);
  EXPECT_EQ(value_of("1" + zeros), infinity);
  EXPECT_EQ(value_of("1" + zeros + "e-2000"), 1);
  EXPECT_EQ(value_of("1" + zeros + "e-1999"), 10);
  EXPECT_EQ(value_of("0." + zeros + "1e2001"), 1);
  EXPECT_EQ(value_of("0." + zeros + "1e2400"), infinity);
  EXPECT_EQ(bits(value_of("0." + zeros + "1")), bits(0.0));
  EXPECT_EQ(bits(value_of("-0." + zeros + "1")), bits(-0.0));
  EXPECT_EQ(bits(value_of("1e-324")), bits(0.0));
  EXPECT_EQ(bits(value_of("-1e-324")), bits(-0.0));
  EXPECT_EQ(bits(value_of("2.4703282292062327e-324")), bits(0.0)); // just below half of the least
  EXPECT_EQ(bits(value_of("1e-99999999999999999999")), bits(0.0));
  EXPECT_EQ(bits(value_of("0e99999999999999999999")), bits(0.0));
  EXPECT_EQ(bits(value_of("-0.0e400")), bits(-0.0));
  EXPECT_EQ(bits(value_of("0." + zeros + "e99999")), bits(0.0));
}

TEST(ParseDouble, SignsAndShortForms)
{
  EXPECT_EQ(bits(value_of("0")), bits(0.0));
  EXPECT_EQ(bits(value_of("-0")), bits(-0.0));
  EXPECT_EQ(bits(value_of("+0")), bits(0.0));
  EXPECT_EQ(value_of("+5"), 5);
  EXPECT_EQ(value_of("+5e+05"), 500000);
  EXPECT_EQ(value_of("-5E-05"), -5e-5);
  EXPECT_EQ(value_of("1e-005"), 1e-5); // old Microsoft libraries: three digits of exponent
  EXPECT_EQ(value_of("5."), 5);
  EXPECT_EQ(value_of(".5"), 0.5);
  EXPECT_EQ(value_of("-.5e1"), -5);
  EXPECT_EQ(value_of("007.500"), 7.5);
  EXPECT_EQ(value_of("-0.470467"), -0.470467);
}

// What glibc prints.
TEST(ParseDouble, NanAndInfinity)
{
  EXPECT_EQ(value_of("inf"), infinity);
  EXPECT_EQ(value_of("-inf"), -infinity);
  EXPECT_EQ(value_of("+inf"), infinity);
  EXPECT_EQ(value_of("INF"), infinity);
  EXPECT_EQ(value_of("Infinity"), infinity);
  EXPECT_EQ(value_of("-infinity"), -infinity);
  for (const char* word : { "nan", "NaN", "NAN", "+nan" })
  {
    EXPECT_TRUE(std::isnan(value_of(word)) && !std::signbit(value_of(word))) << word;
  }
  EXPECT_TRUE(std::isnan(value_of("-nan")));
  EXPECT_TRUE(std::signbit(value_of("-nan")));
}

TEST(ParseDouble, TrapMicrosoftSpellings)
{
  EXPECT_EQ(value_of("1.#INF"), infinity);
  EXPECT_EQ(value_of("-1.#INF"), -infinity);
  EXPECT_EQ(value_of("+1.#INF"), infinity);
  EXPECT_EQ(value_of("1.#INF00"), infinity); // "%f"
  for (const char* word : { "1.#QNAN", "-1.#QNAN", "1.#SNAN", "-1.#IND", "-1.#IND00", "1.#QNAN0" })
  {
    EXPECT_TRUE(std::isnan(value_of(word))) << word;
  }
  for (const char* word : { "1.#", "1.#INX", "1.#INFx", "2.#INF", "1#INF", "#INF", "1.#IN",
         "1.0#INF", "1.#INF-", "1e0#INF" })
  {
    EXPECT_TRUE(is_refused(word)) << word;
  }
}

TEST(ParseDouble, RefusesWhatIsNoNumber)
{
  for (const char* word : { "", "-", "+", "+-1", "-+1", "--1", "++1", "1e", "1e+", "1e-", "e5",
         ".e5", "1.2.3", "..", ".", "-.", "+.", "0x10", "0x1p3", "1,5", "1.5,", "abc", "1a", "a1",
         "1 ", " 1", "1\t", "\n1", "nano", "in", "infx", "1e5.5", "1e5e5", "1_000", "1'000", "1f",
         "1.0f", "--", "0x", "1d5", "1e--5", "\xc2\xb5", "\xff", "1\xff" })
  {
    EXPECT_TRUE(is_refused(word)) << '"' << word << '"';
  }
  EXPECT_TRUE(is_refused(std::string_view("1\0", 2)));
  EXPECT_TRUE(is_refused(std::string_view("\0"
                                          "1",
    2)));
  EXPECT_TRUE(is_refused(std::string_view("1\0"
                                          "2",
    3)));
  EXPECT_TRUE(is_refused(std::string_view("1.#INF\0", 7)));
}

TEST(ParseDouble, TrapLocaleWithADecimalComma)
{
  const std::string folder = GRANULAR_OUTPUT "/locale";
  std::filesystem::create_directories(folder);
  const std::string command = "localedef -i de_DE -f UTF-8 '" + folder + "/de_DE.UTF-8'";
  ASSERT_EQ(std::system(command.c_str()), 0)
    << "the sources of locales are needed (Debian: locales)";
  ASSERT_EQ(setenv("LOCPATH", folder.c_str(), 1), 0);
  ASSERT_NE(std::setlocale(LC_ALL, "de_DE.UTF-8"), nullptr);
  ASSERT_EQ(std::strtod("1,5", nullptr), 1.5);
  EXPECT_EQ(value_of("1.5"), 1.5);
  EXPECT_EQ(value_of("1.2345678901234567890123"), 1.2345678901234567890123);
  EXPECT_TRUE(is_refused("1,5"));
  std::setlocale(LC_ALL, "C");
}

// ---- digits and powers -------------------------------------------------------------------------

// Every power that the tables hold and some that they do not, with digits that fill all 64 bits,
// that are next to a power of two, and that are few.
TEST(NearestDouble, EqualsStrtodForEveryPower)
{
  std::mt19937_64 random(99);
  std::int64_t undecided = 0;
  for (int power = -400; power <= 400; ++power)
  {
    for (int i = 0; i < 300; ++i)
    {
      const std::uint64_t edge = std::uint64_t{ 1 } << (i % 64);
      const std::uint64_t digits = i < 64 ? edge
        : i < 128                         ? edge - 1
        : i < 192                         ? ~std::uint64_t{ 0 } - (edge - 1)
                                          : random() >> (random() % 64);
      const std::string word = std::to_string(digits) + "e" + std::to_string(power);
      double value = 0;
      if (!granular::nearest_double(digits, power, value))
      {
        ++undecided;
        continue;
      }
      ASSERT_EQ(bits(value), bits(std::strtod(word.c_str(), nullptr))) << word;
    }
  }
  EXPECT_LT(undecided, 10) << "numbers for which the product was not enough";
}

// Halfway between two doubles, and one digit beside: integers of 54 bits times powers of two and five.
TEST(NearestDouble, MiddleBetweenTwoDoubles)
{
  std::mt19937_64 random(5);
  for (int power = 0; power <= 23; ++power)
  {
    for (int i = 0; i < 2000; ++i)
    {
      // odd * 5^power has 54 bits: the last is half a unit
      double five = 1;
      for (int k = 0; k < power; ++k)
      {
        five *= 5;
      }
      const double lowest = 0x1p53 / five;
      const auto digits =
        static_cast<std::uint64_t>(lowest * (1 + static_cast<double>(random() >> 11) * 0x1p-53)) |
        1;
      for (const std::uint64_t near : { digits - 1, digits, digits + 1 })
      {
        expect_as_strtod(std::to_string(near) + "e" + std::to_string(power), "middle");
      }
    }
  }
  std::uint64_t ten = 1;
  for (int power = 0; power >= -3; --power, ten *= 10)
  {
    for (int i = 0; i < 2000; ++i)
    {
      // an odd number of 54 bits, as a quotient
      const std::uint64_t digits = ((std::uint64_t{ 1 } << 53) + (random() >> 12 | 1)) * ten;
      for (const std::uint64_t near : { digits - 1, digits, digits + 1 })
      {
        expect_as_strtod(std::to_string(near) + "e" + std::to_string(power), "middle");
      }
    }
  }
}

// The sum of two doubles against 113 bits, which hold 10^48 exactly.
TEST(PowerPairs, HoldPowersOfTen)
{
  Quad power = 1;
  for (int q = 0; q <= 48; ++q, power *= 10)
  {
    const granular::PowerPair& pair =
      granular::power_pairs[static_cast<std::size_t>(q - granular::smallest_power)];
    Quad scale = 1;
    for (int k = 0; k < granular::binary_exponent(q); ++k)
    {
      scale *= 2;
    }
    const Quad error = absolute(static_cast<Quad>(pair.high) + pair.low - power / scale);
    EXPECT_LE(static_cast<double>(error), 0x1p-103) << q;
    EXPECT_GE(pair.high, 1.0);
    EXPECT_LT(pair.high, 2.0);
  }
}

// ---- integers ----------------------------------------------------------------------------------

TEST(ParseInt64, WholeRange)
{
  EXPECT_EQ(integer_of("0"), 0);
  EXPECT_EQ(integer_of("-0"), 0);
  EXPECT_EQ(integer_of("+7"), 7);
  EXPECT_EQ(integer_of("007"), 7);
  EXPECT_EQ(integer_of("2147483648"), 2147483648);
  EXPECT_EQ(integer_of("9223372036854775807"), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(integer_of("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  EXPECT_TRUE(integer_is_refused("9223372036854775808"));
  EXPECT_TRUE(integer_is_refused("-9223372036854775809"));
  EXPECT_TRUE(integer_is_refused("99999999999999999999999999"));
  EXPECT_EQ(integer_of("9007199254740993"), 9007199254740993); // not a double
}

// Ids that went through "%g".
TEST(ParseInt64, IntegersWithPointOrExponent)
{
  EXPECT_EQ(integer_of("1e3"), 1000);
  EXPECT_EQ(integer_of("12.0"), 12);
  EXPECT_EQ(integer_of("-12.000"), -12);
  EXPECT_EQ(integer_of("+12."), 12);
  EXPECT_EQ(integer_of("1.23457e+06"), 1234570);
  EXPECT_EQ(integer_of("1200e-2"), 12);
  EXPECT_EQ(integer_of("9007199254740992.0"), 9007199254740992);
  EXPECT_EQ(integer_of("-9.007199254740992e15"), -9007199254740992);
}

TEST(ParseInt64, RefusesWhatADoubleDoesNotHoldExactly)
{
  // 2^53 + 2 is a double, but so could be the next integer's text: above 2^53 none is taken
  EXPECT_TRUE(integer_is_refused("9007199254740994.0"));
  EXPECT_TRUE(integer_is_refused("1e16"));
  EXPECT_TRUE(integer_is_refused("1e300"));
  for (const char* word : { "1.5", "-0.5", "1e-3", "nan", "inf", "-inf", "1.#INF", "", "-", "+",
         "+-1", "-+1", "1e", "0x10", "1,5", "abc", "1 ", " 1", "." })
  {
    EXPECT_TRUE(integer_is_refused(word)) << '"' << word << '"';
  }
  EXPECT_TRUE(integer_is_refused(std::string_view("1\0", 2)));
}

TEST(ParseInt64, RandomIntegersOfEveryLength)
{
  HardCase hard("ids", "integers of up to 64 bits, read as ids: changed ones", "ids", 0);
  std::mt19937_64 random(7);
  for (int i = 0; i < 200'000; ++i)
  {
    const auto value = static_cast<std::int64_t>(random()) >> (random() % 64);
    const std::int64_t found = integer_of(std::to_string(value));
    hard.add(found == value ? 0 : 1);
    ASSERT_EQ(found, value);
  }
}
