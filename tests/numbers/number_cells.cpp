// SPDX-License-Identifier: BSD-3-Clause
// Columns of numbers as cells of text, against printf and numbers printed one by one.
#include "granular/numbers/number_print.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace
{
using granular::most_number_chars;
using granular::NumberCells;
using granular::NumberFormat;
using granular::Simd;

constexpr char untouched = '#';

/// Cells of which each `step`-th is used. The end of a cell may be written to, other cells may not.
class Sheet
{
public:
  Sheet(std::size_t count, std::size_t step, const std::string& end)
    : text_(count * step * most_number_chars, untouched)
    , lengths_(count * step, 0)
    , step_(step)
    , end_(end)
  {
  }

  NumberCells cells()
  {
    NumberCells cells{ text_.data(), lengths_.data(), step_, {}, 0 };
    cells.end_chars = static_cast<std::uint8_t>(end_.copy(cells.end.data(), cells.end.size()));
    return cells;
  }

  void expect(const std::vector<std::string>& words) const
  {
    for (std::size_t i = 0; i < lengths_.size(); ++i)
    {
      const char* const cell = text_.data() + i * most_number_chars;
      const bool used = i % step_ == 0;
      const std::string wanted = used ? words[i / step_] + end_ : "";
      ASSERT_EQ(std::string(cell, lengths_[i]), wanted) << "cell " << i;
      ASSERT_TRUE(
        used || std::all_of(cell, cell + most_number_chars, [](char c) { return c == untouched; }))
        << "cell " << i;
    }
  }

private:
  std::string text_;
  std::vector<std::uint8_t> lengths_;
  std::size_t step_;
  std::string end_;
};

/// Values with others between them that must not be read, on sheets of all kinds.
template <class Number, class Print>
void expect_cells(
  const std::vector<Number>& values, const std::vector<std::string>& words, Print&& print)
{
  for (const std::size_t step : { 1U, 3U })
  {
    std::vector<Number> spaced(values.size() * step, Number{ 77 });
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      spaced[i * step] = values[i];
    }
    for (const std::string end : { "", " ", "\n", " \n" })
    {
      for (const std::size_t cells : { 1U, 2U, 7U })
      {
        Sheet sheet(values.size(), cells, end);
        print(spaced.data(), static_cast<std::int64_t>(step), values.size(), sheet.cells());
        sheet.expect(words);
      }
    }
  }
}

std::vector<double> hard_doubles()
{
  const double inf = std::numeric_limits<double>::infinity();
  std::vector<double> values = { 0.0, -0.0, inf, -inf, std::nan(""), 5e-324,
    -2.2250738585072014e-308, std::numeric_limits<double>::max(),
    -std::numeric_limits<double>::max(), 0x1p-963, 0x1p53, -0x1p53 - 2, 9007199254740991.0,
    999999.5, 9999995e-10, 0.5, 2.5, 1e5, 123456.5, 1e6, 1e15, 1e16, 1e17, 1e22, 1e23, 0.1, -0.3,
    1.0 / 3, 2.0 / 3, 0.001, -123.456, 999999, -0.5 - 99999, -1e300, 5e-324 };
  for (const double place : { 0x1p-33, 999999.5, 99999.95, 0.9999995 })
  {
    values.insert(values.end(), { std::nextafter(place, 0), place, std::nextafter(place, 1e9) });
  }
  for (int power = -12; power <= 8; ++power)
  {
    const double ten = std::strtod(("1e" + std::to_string(power)).c_str(), nullptr);
    values.insert(values.end(), { std::nextafter(ten, 0), ten, -std::nextafter(ten, 1e9) });
  }
  std::mt19937_64 random(5);
  for (int power = -17; power <= 1; ++power) // nearly halfway between two numbers of six digits
  {
    for (int i = 0; i < 30; ++i)
    {
      const std::string word =
        std::to_string(100'000 + random() % 900'000) + "5e" + std::to_string(power);
      const double halfway = std::strtod(word.c_str(), nullptr);
      const double below = std::nextafter(halfway, 0);
      const double above = std::nextafter(halfway, 1e9);
      values.insert(values.end(),
        { std::nextafter(below, 0), below, halfway, above, std::nextafter(above, 1e9) });
    }
  }
  for (int i = 0; i < 3000; ++i)
  {
    const double unit = static_cast<double>(random() >> 11) * 0x1p-53;
    values.push_back((2 * unit - 1) * std::pow(10.0, static_cast<int>(random() % 30) - 15));
    values.push_back(std::bit_cast<double>(random()));
    values.push_back(std::floor(unit * 2e6) / 2); // a tie of six digits, or integral
    if (std::isnan(values[values.size() - 2]))
    {
      values[values.size() - 2] = 1;
    }
  }
  return values;
}

std::string by_printf(const char* format, double value, int digits)
{
  char word[64];
  std::snprintf(word, sizeof word, format, digits, value);
  return word;
}
}

TEST(NumberCells, as_printf)
{
  const std::vector<double> values = hard_doubles();
  for (int digits = 1; digits <= 17; ++digits)
  {
    std::vector<std::string> words;
    for (const double value : values)
    {
      words.push_back(by_printf("%.*g", value, digits));
    }
    constexpr int found_together = 6;
    const auto sets = granular::instruction_sets();
    for (const Simd simd : digits == found_together ? sets : sets.first(1))
    {
      expect_cells(values, words,
        [&](const double* from, std::int64_t step, std::size_t count, const NumberCells& to)
        { granular::print_numbers(from, step, count, { digits }, false, to, simd); });
    }
  }
}

TEST(NumberCells, any_count)
{
  const std::vector<double> hard = hard_doubles();
  for (std::size_t count = 0; count <= 130; ++count)
  {
    const std::vector<double> values(hard.end() - static_cast<std::ptrdiff_t>(count), hard.end());
    std::vector<std::string> words;
    for (const double value : values)
    {
      words.push_back(by_printf("%.*g", value, 6));
    }
    expect_cells(values, words,
      [&](const double* from, std::int64_t step, std::size_t number, const NumberCells& to)
      { granular::print_numbers(from, step, number, { 6 }, false, to); });
  }
}

TEST(NumberCells, whole_numbers_have_all_digits)
{
  const std::vector<double> values = hard_doubles();
  std::vector<std::string> words;
  for (const double value : values)
  {
    const bool whole = std::abs(value) < 0x1p53 && std::floor(value) == value;
    // an integer has no sign of zero
    words.push_back(whole ? by_printf("%.*f", value + 0.0, 0) : by_printf("%.*g", value, 6));
  }
  words[1] = "0";
  expect_cells(values, words,
    [&](const double* from, std::int64_t step, std::size_t count, const NumberCells& to)
    { granular::print_numbers(from, step, count, { 6 }, true, to); });
}

TEST(NumberCells, shortest_and_exact_forms)
{
  const std::vector<double> values = hard_doubles();
  for (const NumberFormat format :
    { NumberFormat{ 0 }, NumberFormat{ 0, true }, NumberFormat{ 6, true } })
  {
    std::vector<std::string> words;
    for (const double value : values)
    {
      words.push_back(granular::to_text(value, format));
    }
    expect_cells(values, words,
      [&](const double* from, std::int64_t step, std::size_t count, const NumberCells& to)
      { granular::print_numbers(from, step, count, format, false, to); });
  }
}

template <class Integer>
void expect_integers()
{
  using Limits = std::numeric_limits<Integer>;
  std::vector<Integer> values = { 0, 1, -1, 9, 10, -10, 99999999, 100000000, -99999999, -100000000,
    Limits::max(), Limits::min(), Limits::min() + 1 };
  std::mt19937_64 random(6);
  for (int i = 0; i < 3000; ++i)
  {
    values.push_back(static_cast<Integer>(static_cast<std::int64_t>(random()) >> (random() % 64)));
  }
  std::vector<std::string> words;
  for (const Integer value : values)
  {
    words.push_back(std::to_string(value));
  }
  expect_cells(values, words,
    [](const Integer* from, std::int64_t step, std::size_t count, const NumberCells& to)
    { granular::print_integers(from, step, count, to); });
}

TEST(NumberCells, integers)
{
  expect_integers<std::int32_t>();
  expect_integers<std::int64_t>();
}
