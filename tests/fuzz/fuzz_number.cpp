// SPDX-License-Identifier: BSD-3-Clause
// A word: parse_double against strtod, and every path of decode_rows against parse_double and parse_int64.
#include "granular/numbers/number.h"
#include "granular/text/row_text.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

namespace
{
using granular::ColumnSink;
using granular::RowStatus;

void require(bool good, const char* what, const std::string& word)
{
  if (!good)
  {
    std::fprintf(stderr, "%s: '%s'\n", what, word.c_str());
    std::abort();
  }
}

bool same(double a, double b)
{
  return std::isnan(a) ? std::isnan(b) && std::signbit(a) == std::signbit(b)
                       : std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool has(const std::string& word, std::string_view characters)
{
  return word.find_first_of(characters) != word.npos;
}

void check_double(const std::string& word, bool good, double value)
{
  char* end = nullptr;
  const double expected = std::strtod(word.c_str(), &end);
  const bool all = !word.empty() && end == word.c_str() + word.size();
  if (good && !has(word, "#"))
  {
    require(all, "accepted, strtod refuses", word);
    require(same(value, expected), "not what strtod gives", word);
  }
  // strtod reads hexadecimal numbers, nan(...) and blanks in front
  const bool blank_first = !word.empty() && static_cast<unsigned char>(word[0]) <= ' ';
  if (!good && all && !blank_first)
  {
    require(has(word, "xX("), "refused, strtod accepts", word);
  }
}

void check_integer(
  const std::string& word, bool good, std::int64_t value, bool is_number, double number)
{
  if (good)
  {
    require(is_number, "an integer that is no number", word);
    require(
      same(static_cast<double>(value) + 0.0, number + 0.0), "integer and number differ", word);
  }
  else if (is_number)
  {
    require(std::trunc(number) != number || !(std::abs(number) < 9007199254740992.0),
      "refused although an integer", word);
  }
}

/// The word in a row of its own.
template <typename T>
RowStatus decode(const std::string& word, granular::ValueType kind, granular::Simd simd, T& value)
{
  granular::PaddedBuffer buffer(word.size() + 1);
  std::copy(word.begin(), word.end(), buffer.data());
  buffer.data()[word.size()] = '\n';
  ColumnSink sink{ 0, kind, reinterpret_cast<char*>(&value), sizeof value };
  granular::RowMemory memory;
  return granular::decode_rows(
    buffer.data(), buffer.data() + buffer.size(), 1, { &sink, 1 }, 1, memory, simd)
    .status;
}

void check_rows(
  const std::string& word, bool is_number, double number, bool is_integer, std::int64_t integer)
{
  for (const granular::Simd simd : granular::instruction_sets())
  {
    double d = 0;
    const RowStatus as_double = decode(word, granular::ValueType::Float64, simd, d);
    require((as_double == RowStatus::Done) == is_number, "row: status of a double", word);
    require(!is_number || same(d, number), "row: value of a double", word);
    std::int64_t i = 0;
    const RowStatus as_integer = decode(word, granular::ValueType::Int64, simd, i);
    const RowStatus expected = is_integer ? RowStatus::Done
      : is_number                         ? RowStatus::NotExact
                                          : RowStatus::NotANumber;
    require(as_integer == expected, "row: status of an integer", word);
    require(!is_integer || i == integer, "row: value of an integer", word);
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const char* const first = reinterpret_cast<const char*>(data);
  const std::string word(first, size);
  double number = 0;
  std::int64_t integer = 0;
  const bool is_number{ granular::parse_double(first, first + size, number) };
  const bool is_integer{ granular::parse_int64(first, first + size, integer) };
  if (word.find('\0') == word.npos)
  {
    check_double(word, is_number, number);
  }
  check_integer(word, is_integer, integer, is_number, number);
  const bool one_word =
    size > 0 && std::all_of(data, data + size, [](std::uint8_t byte) { return byte > ' '; });
  if (one_word)
  {
    check_rows(word, is_number, number, is_integer, integer);
  }
  return 0;
}
