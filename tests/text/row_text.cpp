// SPDX-License-Identifier: BSD-3-Clause
#include "granular/text/row_text.h"

#include "../support/decimals.h"
#include "../support/row_decoding.h"
#include "granular/numbers/number.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <span>
#include <string>
#include <vector>

namespace
{
using granular::ColumnSink;
using granular::RowStatus;
using granular::Simd;
using granular::ValueType;

constexpr std::int64_t all_rows = std::int64_t{ 1 } << 60;

/// What decode_rows has to say of a row of one word.
struct Word
{
  RowStatus status;
  std::uint64_t bits;
};

Word as_double(std::string_view word)
{
  double value = 0;
  const bool good{ granular::parse_double(word.data(), word.data() + word.size(), value) };
  return { good ? RowStatus::Done : RowStatus::NotANumber, std::bit_cast<std::uint64_t>(value) };
}

Word as_int64(std::string_view word)
{
  std::int64_t value = 0;
  const bool good{ granular::parse_int64(word.data(), word.data() + word.size(), value) };
  const RowStatus otherwise =
    as_double(word).status == RowStatus::Done ? RowStatus::NotExact : RowStatus::NotANumber;
  return { good ? RowStatus::Done : otherwise, static_cast<std::uint64_t>(value) };
}

void expect_word(std::string_view word, ValueType kind, Simd simd)
{
  const Word expected = kind == ValueType::Float64 ? as_double(word) : as_int64(word);
  const Decoded got = decode(std::string(word) + '\n', 1, { { 0, kind } }, all_rows, simd);
  const bool good = expected.status == RowStatus::Done;
  ASSERT_EQ(got.status, expected.status) << '"' << word << "\" " << to_string(simd);
  ASSERT_EQ(got.rows, good ? 1 : 0) << word;
  if (good)
  {
    ASSERT_EQ(got.bits[0][0], expected.bits) << '"' << word << "\" " << to_string(simd);
  }
}

Decoded decode_all(std::string_view text, std::uint32_t columns, const std::vector<Wanted>& wanted,
  std::int64_t max_rows = all_rows)
{
  const Decoded plain = decode(text, columns, wanted, max_rows, Simd::Portable);
  for (const Simd simd : granular::instruction_sets())
  {
    const Decoded other = decode(text, columns, wanted, max_rows, simd);
    EXPECT_EQ(other, plain) << to_string(simd) << ": " << to_string(other)
                            << "\nPortable: " << to_string(plain) << "\ncolumns " << columns
                            << ", text:\n"
                            << text.substr(0, 2000);
  }
  return plain;
}

double number(std::uint64_t bits)
{
  return std::bit_cast<double>(bits);
}

std::vector<double> numbers(const std::vector<std::uint64_t>& bits)
{
  std::vector<double> values;
  std::transform(bits.begin(), bits.end(), std::back_inserter(values), number);
  return values;
}
}

// ---- words -------------------------------------------------------------------------------------

TEST(DecodeRows, NumbersAsByParseDoubleToTheBit)
{
  Decimals decimals(77);
  std::mt19937_64 random(5);
  constexpr const char* separators[] = { " ", "  ", "\t", " \t ", "\r", "   " };
  constexpr std::uint32_t columns = 50;
  std::vector<Wanted> wanted;
  for (std::uint32_t i = 0; i < columns; ++i)
  {
    wanted.push_back({ i, ValueType::Float64 });
  }
  const std::int64_t rows = numbers_to_try(200'000) / columns;
  for (std::int64_t row = 0; row < rows && !HasFailure(); ++row)
  {
    std::string text(random() % 64, ' ');
    std::vector<std::uint64_t> expected;
    for (std::uint32_t i = 0; i < columns; ++i)
    {
      const std::string& word = decimals.next();
      expected.push_back(as_double(word).bits);
      text += word + separators[random() % std::size(separators)];
    }
    text += '\n';
    for (const Simd simd : granular::instruction_sets())
    {
      const Decoded got = decode(text, columns, wanted, all_rows, simd);
      ASSERT_EQ(got.rows, 1) << to_string(got) << " " << to_string(simd) << "\n" << text;
      for (std::uint32_t i = 0; i < columns; ++i)
      {
        ASSERT_EQ(got.bits[i][0], expected[i])
          << "column " << i << " of " << text << to_string(simd);
      }
    }
  }
}

namespace
{
/// Rows of words that are all alike: none of them keeps the others from being parsed together.
void expect_alike(const std::vector<std::string>& words, const std::string& what)
{
  constexpr std::uint32_t columns = 16;
  std::vector<Wanted> wanted;
  for (std::uint32_t i = 0; i < columns; ++i)
  {
    wanted.push_back({ i, ValueType::Float64 });
  }
  std::string text;
  for (std::size_t i = 0; i < words.size() / columns * columns; ++i)
  {
    text += words[i] + (i % columns + 1 == columns ? "\n" : " ");
  }
  for (const Simd simd : granular::instruction_sets())
  {
    const Decoded got = decode(text, columns, wanted, all_rows, simd);
    ASSERT_EQ(static_cast<std::size_t>(got.rows), words.size() / columns) << what;
    for (std::size_t i = 0; i < words.size() / columns * columns; ++i)
    {
      const double expected = std::strtod(words[i].c_str(), nullptr);
      ASSERT_EQ(got.bits[i % columns][i / columns], std::bit_cast<std::uint64_t>(expected))
        << words[i] << ' ' << to_string(simd) << ' ' << what;
    }
  }
}
}

// Words of about the same length are parsed together, long ones and short ones in different ways.
TEST(DecodeRows, NumbersAmongTheirLike)
{
  Decimals decimals(1234);
  constexpr std::size_t limits[] = { 8, 16, 26, 27, 32, 40, 1000 };
  std::vector<std::string> alike[std::size(limits)];
  const std::int64_t count = numbers_to_try(200'000);
  for (std::int64_t i = 0; i < count && !HasFailure(); ++i)
  {
    const std::string& word = decimals.next();
    const bool common = word[0] != '+' && word.find_first_of("eE") + 1 != word.size();
    const std::size_t length = common ? word.size() : 1000;
    const auto kind = static_cast<std::size_t>(
      std::lower_bound(std::begin(limits), std::end(limits), length) - std::begin(limits));
    alike[kind].push_back(word);
    if (alike[kind].size() == 160)
    {
      expect_alike(alike[kind], decimals.kind());
      alike[kind].clear();
    }
  }
}

// Every power of ten that counts, with digits that need all bits, and with few.
TEST(DecodeRows, EveryPowerOfTenAmongItsLike)
{
  constexpr const char* mantissas[] = { "1", "-9", "1.5", "-7.25", "9007199254740991",
    "9007199254740993", "4.503599627370497", "-1.2345678901234567", "9.9999999999999999",
    "1.000000000000000001", "-0.000123456", "0.0", "7205759403792793", "922337203685477580",
    "-1844674407370955161", "1.797693134862315807" };
  for (int power = -400; power <= 400 && !HasFailure(); ++power)
  {
    char exponent[16];
    std::snprintf(exponent, sizeof exponent, "e%+03d", power);
    std::vector<std::string> mixed;
    for (const char* mantissa : mantissas)
    {
      mixed.push_back(mantissa + std::string(exponent));
      expect_alike(std::vector<std::string>(16, mixed.back()), exponent);
    }
    expect_alike(mixed, exponent);
  }
}

// One that is not common among 31 that are, at every place.
TEST(DecodeRows, OneThatIsDifferent)
{
  const std::string zeros(20, '0');
  const std::vector<std::string> others = { "nan", "-inf", "+5", "1e5", "-1E-5", "1e-05",
    "-1.5e+005", "2.5e-100", "1.#INF", "4.9e-324", "1e-400", "1e400", "0." + zeros + "12345678",
    "1" + zeros + zeros, "1234567" + zeros + ".0", "-12345678901234567890123456789012",
    "1" + zeros + "000000", "1" + zeros + "00000000000", "9007199254740993", "-9007199254740993.0",
    "0.1234567890123456", "12345678901234567e-05", "1234567890123456789.5e-100" };
  for (const std::string& other : others)
  {
    for (std::size_t place = 0; place < 32; ++place)
    {
      std::vector<std::string> words;
      for (std::size_t i = 0; i < 32; ++i)
      {
        words.push_back(i == place ? other : "-0.12345" + std::to_string(i));
      }
      for (std::size_t i = 0; i < 32; ++i)
      {
        const Decoded got = decode_all(words[i] + "\n", 1, { { 0, ValueType::Float64 } });
        ASSERT_EQ(got.rows, 1) << words[i];
      }
      std::string text;
      for (const std::string& word : words)
      {
        text += word + "\n";
      }
      const Decoded got = decode_all(text, 1, { { 0, ValueType::Float64 } });
      ASSERT_EQ(got.rows, 32) << other;
      for (std::size_t i = 0; i < 32; ++i)
      {
        ASSERT_EQ(got.bits[0][i], as_double(words[i]).bits) << words[i] << " beside " << other;
      }
    }
  }
}

// A word that is no number among many that are: every path must find it.
TEST(DecodeRows, OneThatIsNoNumber)
{
  for (const char* wrong : { "-", ".", "-.", "1.2.3", "1-2", "--1", "1e", "1e+", "1e-", "e-05",
         "1e-24.", "1.5e-05.", "1e-2.4", "1e.-05", "1.e-0.5", "1ee-05", "1e-0.", "1.5e05.", "-e-05",
         ".e-05", "1e--5", "12e-1e-05", "1-e-05", "1,5", "1.2345678901234567e-0x",
         "1.23456789012345.67e-05", "1234567890123456789e--05", "x" })
  {
    for (int place = 0; place < 16; ++place)
    {
      std::string doubles;
      std::string integers;
      for (int i = 0; i < 16; ++i)
      {
        doubles += (i == place ? std::string(wrong) : "-0.25e-05") + "\n";
        integers += (i == place ? std::string(wrong) : "-12345") + "\n";
      }
      const Decoded got = decode_all(doubles, 1, { { 0, ValueType::Float64 } });
      ASSERT_EQ(got.status, RowStatus::NotANumber) << wrong;
      ASSERT_EQ(got.rows, place) << wrong;
      const Decoded whole = decode_all(integers, 1, { { 0, ValueType::Int64 } });
      ASSERT_EQ(whole.status, RowStatus::NotANumber) << wrong;
      ASSERT_EQ(whole.rows, place) << wrong;
    }
  }
}

TEST(DecodeRows, IntegersOfEveryLengthAmongTheirLike)
{
  std::mt19937_64 random(17);
  for (int digits = 1; digits <= 19; ++digits)
  {
    for (int round = 0; round < 50; ++round)
    {
      std::string text;
      std::vector<std::uint64_t> expected;
      for (int i = 0; i < 37; ++i)
      {
        std::string word = std::to_string(random() | std::uint64_t{ 1 } << 63);
        word = "0" + word.substr(0, static_cast<std::size_t>(digits) - 1);
        word = (random() % 2 == 0 ? "-" : "") + word;
        text += word + "\n";
        expected.push_back(static_cast<std::uint64_t>(std::strtoll(word.c_str(), nullptr, 10)));
      }
      ASSERT_EQ(decode_all(text, 1, { { 0, ValueType::Int64 } }).bits[0], expected) << digits;
    }
  }
}

// Every word of up to five characters out of these, as a double and as an integer.
TEST(DecodeRows, EveryShortWord)
{
  constexpr std::string_view alphabet = "059.-+eE/";
  const std::span<const Simd> sets = granular::instruction_sets();
  for (std::size_t length = 1; length <= 5; ++length)
  {
    std::string word(length, alphabet.front());
    std::vector<std::size_t> digits(length, 0);
    for (std::size_t carry = 0; carry < length && !HasFailure();)
    {
      for (const Simd simd : sets)
      {
        expect_word(word, ValueType::Float64, simd);
        expect_word(word, ValueType::Int64, simd);
      }
      for (carry = 0; carry < length; ++carry)
      {
        digits[carry] = (digits[carry] + 1) % alphabet.size();
        word[carry] = alphabet[digits[carry]];
        if (digits[carry] != 0)
        {
          break;
        }
      }
    }
  }
}

// Words of 1 to 24 characters, most of them digits, so that many are numbers.
TEST(DecodeRows, RandomWords)
{
  std::mt19937_64 random(11);
  constexpr std::string_view digits = "0123456789";
  constexpr std::string_view others = "..--++eEe:/,x\x7f\x80\xff#nai";
  const std::span<const Simd> sets = granular::instruction_sets();
  for (int i = 0; i < 100'000 && !HasFailure(); ++i)
  {
    const std::size_t length = 1 + random() % 24;
    std::string word;
    while (word.size() < length)
    {
      word += random() % 8 == 0 ? others[random() % others.size()] : digits[random() % 10];
    }
    for (const Simd simd : sets)
    {
      expect_word(word, ValueType::Float64, simd);
      expect_word(word, ValueType::Int64, simd);
    }
  }
}

TEST(DecodeRows, WordsAtEveryAlignment)
{
  const std::vector<std::string> words = { "1", "-2", "3.5", "-0.25", "1e5", "12345", "-1.5e+08",
    "1.25e-05", "1234567890123456", "-1234567890123456", "123456789012345678", "0.1234567890123456",
    "1.7976931348623157e+308", "-2.2250738585072014e-308", "inf", "-nan", "0.000001",
    "99999999.5" };
  for (const std::string& word : words)
  {
    for (std::size_t before = 0; before < 130; ++before)
    {
      const std::string text = std::string(before, ' ') + word + " 7\n";
      const Decoded got =
        decode_all(text, 2, { { 0, ValueType::Float64 }, { 1, ValueType::Int64 } });
      ASSERT_EQ(got.rows, 1) << word << " behind " << before << " blanks";
      ASSERT_EQ(got.bits[0][0], as_double(word).bits) << word << " behind " << before << " blanks";
      ASSERT_EQ(got.bits[1][0], 7u);
    }
  }
}

TEST(DecodeRows, TrapSignsExponentsAndSpellings)
{
  const Decoded got = decode_all("+1.5 -0 1e-005 1.#INF -1.#IND nan -inf +12\n", 8,
    { { 0, ValueType::Float64 }, { 1, ValueType::Float64 }, { 2, ValueType::Float64 },
      { 3, ValueType::Float64 }, { 4, ValueType::Float64 }, { 5, ValueType::Float64 },
      { 6, ValueType::Float64 }, { 7, ValueType::Int32 } });
  ASSERT_EQ(got.rows, 1);
  EXPECT_EQ(number(got.bits[0][0]), 1.5);
  EXPECT_EQ(got.bits[1][0], std::uint64_t{ 1 } << 63);
  EXPECT_EQ(number(got.bits[2][0]), 1e-5);
  EXPECT_TRUE(std::isinf(number(got.bits[3][0])));
  EXPECT_TRUE(std::isnan(number(got.bits[4][0])));
  EXPECT_TRUE(std::isnan(number(got.bits[5][0])));
  EXPECT_EQ(number(got.bits[6][0]), -HUGE_VAL);
  EXPECT_EQ(got.bits[7][0], 12u);
}

TEST(DecodeRows, Int32HasItsOwnRange)
{
  const std::vector<Wanted> wanted = { { 0, ValueType::Int32 } };
  const Decoded good = decode_all("2147483647\n-2147483648\n1e3\n-0\n", 1, wanted);
  ASSERT_EQ(good.rows, 4);
  EXPECT_EQ(good.bits[0], (std::vector<std::uint64_t>{ 0x7fffffffu, 0x80000000u, 1000u, 0u }));
  for (const char* word : { "2147483648", "-2147483649", "9223372036854775807", "1.5", "nan",
         "1e10", "9999999999999999999999" })
  {
    const Decoded bad = decode_all("1\n" + std::string(word) + "\n", 1, wanted);
    EXPECT_EQ(bad.status, RowStatus::NotExact) << word;
    EXPECT_EQ(bad.rows, 1) << word;
    EXPECT_EQ(bad.stopped_at, 2) << word;
    EXPECT_EQ(bad.column, 0) << word;
  }
  EXPECT_EQ(decode_all("1\n1,5\n", 1, wanted).status, RowStatus::NotANumber);
}

// ---- rows --------------------------------------------------------------------------------------

TEST(DecodeRows, PicksTheColumnsWanted)
{
  const Decoded got =
    decode_all("1 2 aa 4\n5 6 bb 8\n", 4, { { 1, ValueType::Float64 }, { 2, ValueType::Text } });
  EXPECT_EQ(got.rows, 2);
  EXPECT_EQ(got.status, RowStatus::Done);
  EXPECT_EQ(got.stopped_at, 18);
  EXPECT_EQ(numbers(got.bits[0]), (std::vector<double>{ 2, 6 }));
  EXPECT_EQ(got.texts[1], (std::vector<std::string>{ "aa", "bb" }));
}

TEST(DecodeRows, WordsThatNobodyWantsAreNotLookedAt)
{
  const Decoded got = decode_all("x 2 #!\n? 6 \xff\n", 3, { { 1, ValueType::Int64 } });
  EXPECT_EQ(got.rows, 2);
  EXPECT_EQ(got.bits[0], (std::vector<std::uint64_t>{ 2, 6 }));
  EXPECT_EQ(decode_all("x 2 #!\n? 6 \xff\n", 3, {}).rows, 2);
}

TEST(DecodeRows, NothingToDecode)
{
  EXPECT_EQ(decode_all("", 3, { { 0, ValueType::Float64 } }).rows, 0);
  const Decoded blank = decode_all("\n \n\t\r\n\n", 3, { { 0, ValueType::Float64 } });
  EXPECT_EQ(blank.rows, 0);
  EXPECT_EQ(blank.status, RowStatus::Done);
  EXPECT_EQ(blank.stopped_at, 7);
}

TEST(DecodeRows, TrapBlanksTabsCarriageReturnsAndBlankLines)
{
  const Decoded got = decode_all("\n1 2\r\n \t3\t4 \t\r\n\r\n\n  5    6   \n \n7\v8\f\n", 2,
    { { 0, ValueType::Float64 }, { 1, ValueType::Float64 } });
  EXPECT_EQ(got.rows, 4);
  EXPECT_EQ(got.status, RowStatus::Done);
  EXPECT_EQ(numbers(got.bits[0]), (std::vector<double>{ 1, 3, 5, 7 }));
  EXPECT_EQ(numbers(got.bits[1]), (std::vector<double>{ 2, 4, 6, 8 }));
}

TEST(DecodeRows, StopsAtTheRowsAskedFor)
{
  const std::string text = "1\n\n2\n3\n";
  EXPECT_EQ(decode_all(text, 1, { { 0, ValueType::Int64 } }, 0).stopped_at, 0);
  EXPECT_EQ(decode_all(text, 1, { { 0, ValueType::Int64 } }, 1).stopped_at, 2);
  const Decoded two = decode_all(text, 1, { { 0, ValueType::Int64 } }, 2);
  EXPECT_EQ(two.rows, 2);
  EXPECT_EQ(two.stopped_at, 5);
  EXPECT_EQ(two.bits[0], (std::vector<std::uint64_t>{ 1, 2 }));
}

TEST(DecodeRows, RowTooShort)
{
  const Decoded got = decode_all("1 2 3\n\n 4 5\n6 7 8\n", 3, { { 0, ValueType::Float64 } });
  EXPECT_EQ(got.status, RowStatus::TooFew);
  EXPECT_EQ(got.rows, 1);
  EXPECT_EQ(got.stopped_at, 7);
  EXPECT_EQ(got.bits[0].size(), 1u);
}

TEST(DecodeRows, WordThatIsNoNumber)
{
  const Decoded got =
    decode_all("1 2 3\n4 x5 6\n", 3, { { 0, ValueType::Float64 }, { 1, ValueType::Float64 } });
  EXPECT_EQ(got.status, RowStatus::NotANumber);
  EXPECT_EQ(got.rows, 1);
  EXPECT_EQ(got.column, 1);
  EXPECT_EQ(got.stopped_at, 8);
}

// Two things wrong in one row: every path must name the same one.
TEST(DecodeRows, ShortRowWithAWordThatIsNoNumber)
{
  decode_all("1 2 3\nx 5\n", 3, { { 0, ValueType::Float64 }, { 2, ValueType::Float64 } });
  decode_all("1 2 3\n4.5 5\n", 3, { { 0, ValueType::Int64 }, { 2, ValueType::Float64 } });
}

TEST(DecodeRows, RowWithMoreWordsThanColumns)
{
  for (const std::uint32_t column : { 0U, 1U }) // the first one alone has a way of its own
  {
    const Decoded got = decode_all("1 2\n3 4 5\n6 7\n", 2, { { column, ValueType::Int64 } });
    EXPECT_EQ(got.status, RowStatus::Surplus);
    EXPECT_EQ(got.rows, 1);
    EXPECT_EQ(got.stopped_at, 4);
    const Decoded comments =
      decode_all("1 2 #\n3 4 # 5 #x\n6 7 #8\n", 2, { { column, ValueType::Int64 } });
    EXPECT_EQ(comments.status, RowStatus::Done);
    EXPECT_EQ(comments.bits[0],
      column == 0 ? (std::vector<std::uint64_t>{ 1, 3, 6 })
                  : (std::vector<std::uint64_t>{ 2, 4, 7 }));
  }
}

// A NUL is a blank like all bytes up to ' '; bytes from 0x7f on are parts of words.
TEST(DecodeRows, BytesThatNoTextShouldHold)
{
  using namespace std::string_view_literals;
  const Decoded got =
    decode_all("1\0002\n\x7f\x80 \xff\n"sv, 2, { { 0, ValueType::Text }, { 1, ValueType::Text } });
  EXPECT_EQ(got.rows, 2);
  EXPECT_EQ(got.texts[0], (std::vector<std::string>{ "1", "\x7f\x80" }));
  EXPECT_EQ(got.texts[1], (std::vector<std::string>{ "2", "\xff" }));
  EXPECT_EQ(decode_all("1 2\0x\n"sv, 3, { { 1, ValueType::Float64 } }).rows, 1);
}

// The decoder works through 16 KiB at a time.
TEST(DecodeRows, TrapHundredsAndThousandsOfColumns)
{
  for (const std::uint32_t columns : { 300u, 1000u, 3000u, 8191u, 8192u, 8193u, 20000u, 70000u })
  {
    std::string text;
    for (std::uint32_t row = 0; row < 3; ++row)
    {
      for (std::uint32_t i = 0; i < columns; ++i)
      {
        text += std::to_string(row * columns + i) + (i % 7 == 0 ? "  " : " ");
      }
      text += "\n";
    }
    const Decoded got = decode_all(text, columns,
      { { 0, ValueType::Int64 }, { columns / 2, ValueType::Float64 },
        { columns - 1, ValueType::Int64 } });
    ASSERT_EQ(got.rows, 3) << columns;
    for (std::uint32_t row = 0; row < 3; ++row)
    {
      EXPECT_EQ(got.bits[0][row], row * columns);
      EXPECT_EQ(number(got.bits[1][row]), row * columns + columns / 2);
      EXPECT_EQ(got.bits[2][row], (row + 1) * columns - 1);
    }
  }
}

TEST(DecodeRows, WordsAcrossTheEndOfABatch)
{
  for (std::size_t shift = 16384 - 80; shift < 16384 + 80; ++shift)
  {
    // one line of one word and many blanks, then rows that lie across 16384
    const std::string text =
      "1" + std::string(shift - 60, ' ') + "2\n-1.25e+03 12345678901234567\n0.5 3\n\n7 8\n";
    const Decoded got = decode_all(text, 2, { { 0, ValueType::Float64 }, { 1, ValueType::Int64 } });
    ASSERT_EQ(got.rows, 4) << shift;
    ASSERT_EQ(numbers(got.bits[0]), (std::vector<double>{ 1, -1250, 0.5, 7 }));
    ASSERT_EQ(got.bits[1], (std::vector<std::uint64_t>{ 2, 12345678901234567, 3, 8 }));
  }
}

TEST(DecodeRows, AWordLongerThanABatch)
{
  const std::string digits(40000, '3');
  const Decoded got = decode_all(
    "0." + digits + " 1\n2 3\n", 2, { { 0, ValueType::Float64 }, { 1, ValueType::Int64 } });
  ASSERT_EQ(got.rows, 2);
  EXPECT_EQ(number(got.bits[0][0]), 1.0 / 3);
}

// ---- random texts: all paths do the same --------------------------------------------------------

namespace
{
class RandomText
{
public:
  explicit RandomText(std::uint64_t seed)
    : random_(seed)
  {
  }

  std::uint64_t below(std::uint64_t n) { return random_() % n; }

  std::string word(bool any_bytes)
  {
    std::string word;
    const std::size_t length = 1 + this->below(this->below(4) == 0 ? 60 : 12);
    constexpr std::string_view alphabet = "0123456789012345678901234567890123456789.-+eE";
    for (std::size_t i = 0; i < length; ++i)
    {
      word += any_bytes && this->below(40) == 0 ? static_cast<char>(this->below(256))
                                                : alphabet[this->below(alphabet.size())];
    }
    return word;
  }

  std::string number()
  {
    return this->below(2) == 0
      ? std::to_string(static_cast<int>(this->below(2'000'000)) - 1'000'000)
      : decimals_.next();
  }

  std::string gap(bool wild)
  {
    constexpr std::string_view blanks = " \t\r\v\f\x01\x1f";
    std::string gap;
    const std::size_t length = 1 + (wild ? this->below(4) == 0 ? this->below(90) : 0 : 0);
    for (std::size_t i = 0; i < length; ++i)
    {
      gap += wild ? this->below(50) == 0 ? '\0' : blanks[this->below(blanks.size())] : ' ';
    }
    return gap;
  }

  /// A text of about bytes bytes. faults: how rare rows are that cannot be decoded; 0: none.
  std::string make(std::uint32_t columns, std::size_t bytes, std::uint64_t faults)
  {
    const bool wild = this->below(2) == 0;
    std::string text;
    while (text.size() < bytes)
    {
      std::uint32_t words = columns;
      if (this->below(30) == 0)
      {
        words += static_cast<std::uint32_t>(this->below(5));
      }
      const bool fault = faults != 0 && this->below(faults) == 0;
      if (fault && this->below(2) == 0)
      {
        words = static_cast<std::uint32_t>(this->below(columns + 1));
      }
      text += this->below(3) == 0 ? this->gap(wild) : "";
      for (std::uint32_t i = 0; i < words; ++i)
      {
        text += i == columns && !fault ? "#" : ""; // a comment
        text += fault && this->below(3) == 0 ? this->word(true) : this->number();
        text += i + 1 < words || this->below(3) == 0 ? this->gap(wild) : "";
      }
      text += '\n';
      text += this->below(20) == 0 ? std::string(this->below(70), '\n') : "";
    }
    return text;
  }

private:
  std::mt19937_64 random_;
  Decimals decimals_{ 99 };
};

std::vector<Wanted> some_columns(RandomText& random, std::uint32_t columns)
{
  constexpr ValueType kinds[] = { ValueType::Float64, ValueType::Float64, ValueType::Text,
    ValueType::Int64, ValueType::Int32 };
  const std::uint64_t density = 1 + random.below(4);
  std::vector<Wanted> wanted;
  for (std::uint32_t i = 0; i < columns; ++i)
  {
    if (random.below(density) == 0)
    {
      // integers seldom: most random words are none, and the first fault ends the decoding
      const std::uint64_t kind = random.below(3 * columns + 10) == 0 ? 5 : 3;
      wanted.push_back({ i, kinds[random.below(kind)] });
    }
  }
  return wanted;
}

/// The same with an integer before each line.
std::string with_integers(RandomText& random, const std::string& text)
{
  std::string more;
  bool begins = true;
  for (const char c : text)
  {
    if (begins && c != '\n')
    {
      more += random.below(5) == 0 ? random.gap(true) : "";
      more += random.below(400) == 0 ? random.word(true)
        : random.below(9) == 0
        ? std::to_string(static_cast<std::int64_t>(random.below(std::uint64_t{ 1 } << 63)))
        : std::to_string(static_cast<int>(random.below(9'000'000)) - 100'000);
      more += random.gap(random.below(5) == 0);
    }
    more += c;
    begins = c == '\n';
  }
  return more;
}

/// Decodes random texts on all paths: some columns, or a first one of integers alone.
void decode_random(unsigned seed, bool first_only)
{
  RandomText random(seed);
  std::int64_t rows = 0;
  std::int64_t faults = 0;
  for (int i = 0; i < 1500 && !testing::Test::HasFailure(); ++i)
  {
    const auto columns =
      static_cast<std::uint32_t>(1 + random.below(random.below(10) == 0 ? 300 : 14));
    const std::size_t bytes = random.below(10) == 0 ? 60'000 : random.below(3'000);
    const std::string text =
      random.make(columns, bytes, random.below(4) == 0 ? 0 : 1 + random.below(200));
    const std::vector<Wanted> wanted =
      first_only ? std::vector<Wanted>{ { 0, ValueType::Int64 } } : some_columns(random, columns);
    const std::int64_t most =
      random.below(3) == 0 ? static_cast<std::int64_t>(random.below(100)) : all_rows;
    const Decoded got = first_only
      ? decode_all(with_integers(random, text), columns + 1, wanted, most)
      : decode_all(text, columns, wanted, most);
    rows += got.rows;
    faults += got.status == RowStatus::Done ? 0 : 1;
  }
  EXPECT_GT(rows, 20'000) << "the texts are not what they should be";
  EXPECT_GT(faults, 100);
}
}

TEST(DecodeRows, RandomTextsAreTheSameOnAllPaths)
{
  decode_random(4242, false);
}

TEST(DecodeRows, FirstColumnAloneIsTheSameOnAllPaths)
{
  decode_random(1717, true);
}

// Bytes without any shape.
TEST(DecodeRows, GarbageIsTheSameOnAllPaths)
{
  RandomText random(31337);
  for (int i = 0; i < 3000 && !HasFailure(); ++i)
  {
    std::string text;
    const std::uint64_t range = 1 + random.below(256);
    const std::uint64_t low = random.below(257 - range);
    for (std::uint64_t size = random.below(600); size > 0; --size)
    {
      text += random.below(20) == 0 ? '\n' : static_cast<char>(low + random.below(range));
    }
    text += '\n';
    const auto columns = static_cast<std::uint32_t>(1 + random.below(5));
    decode_all(text, columns, some_columns(random, columns));
  }
}
