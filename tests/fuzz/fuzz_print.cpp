// SPDX-License-Identifier: BSD-3-Clause
// Doubles as their bits, printed in every format: against std::to_chars and snprintf, and read again as the same number. The
// bytes as a text are a format to parse, too.
#include "granular/common/error.h"
#include "granular/numbers/number.h"
#include "granular/numbers/number_print.h"
#include "granular/numbers/number_print_few.h"

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

using namespace granular;

namespace
{
constexpr int most_digits = 17;

void require(bool good, const char* what, double value, const std::string& got)
{
  if (!good)
  {
    std::fprintf(stderr, "%s: %a printed as '%s'\n", what, value, got.c_str());
    std::abort();
  }
}

bool same(double a, double b)
{
  return std::isnan(a) ? std::isnan(b) && std::signbit(a) == std::signbit(b)
                       : std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// Prints into memory of exactly the size that is promised to be enough.
std::string print(double value, NumberFormat format)
{
  std::array<char, most_number_chars> text;
  return { text.data(), print_number(text.data(), value, format) };
}

std::string with_printf(double value, int digits)
{
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

double read(const std::string& text, double value)
{
  double back = 0;
  require(static_cast<bool>(parse_double(text.data(), text.data() + text.size(), back)),
    "is no number", value, text);
  return back;
}

void check_digits(double value, int digits)
{
  const std::string plain = print(value, { digits });
  require(plain == with_printf(value, digits), "not what snprintf gives", value, plain);
  require(same(as_printed(value, { digits }), read(plain, value)), "as_printed", value, plain);

  int needed = digits;
  while (
    needed < most_digits && !same(std::strtod(with_printf(value, needed).c_str(), nullptr), value))
  {
    ++needed;
  }
  const std::string exact = print(value, { digits, true });
  require(exact == with_printf(value, needed) || (needed > digits && exact == print(value, { 0 })),
    "not the digits that are needed", value, exact);
  require(same(read(exact, value), value), "exact: another number", value, exact);
  require(same(as_printed(value, { digits, true }), value), "as_printed, exact", value, exact);
}

void check_shortest(double value)
{
  const std::string shortest = print(value, { 0 });
  require(same(read(shortest, value), value), "shortest: another number", value, shortest);
  require(to_text(value) == shortest, "to_text", value, to_text(value));
  require(print(value, automatic_numbers) == shortest, "automatic", value, shortest);
  if (!std::isnan(value))
  {
    std::array<char, 32> expected;
    const char* const end =
      std::to_chars(expected.data(), expected.data() + expected.size(), value).ptr;
    require(shortest == std::string_view(expected.data(), end), "not what to_chars gives", value,
      shortest);
  }
}

void check_fixed(double value)
{
  std::array<char, most_fixed_chars> text;
  const std::string fixed(text.data(), print_fixed(text.data(), value));
  std::array<char, 512> expected;
  std::snprintf(expected.data(), expected.size(), "%f", value);
  require(fixed == expected.data(), "fixed: not what snprintf gives", value, fixed);
  require(same(as_fixed(value), read(fixed, value)), "as_fixed", value, fixed);
}

void check_integer(std::int64_t value)
{
  std::array<char, most_number_chars> text;
  const std::string printed(text.data(), number_print::print_whole(text.data(), value));
  require(printed == std::to_string(value), "integer", static_cast<double>(value), printed);
  std::int64_t back = 0;
  require(parse_int64(printed.data(), printed.data() + printed.size(), back) && back == value,
    "another integer", static_cast<double>(value), printed);
}

/// Numbers of six digits, which are found together where the processor can.
void check_cells(double value)
{
  const std::array<double, 5> values = { value, value / 3, 0, -value, 1e5 * value };
  std::array<char, values.size() * most_number_chars> text;
  std::array<std::uint8_t, values.size()> lengths;
  for (const Simd simd : instruction_sets())
  {
    print_numbers(values.data(), 1, values.size(), { 6 }, false,
      { text.data(), lengths.data(), 1, {}, 0 }, simd);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      const std::string cell(text.data() + i * most_number_chars, lengths[i]);
      require(cell == with_printf(values[i], 6), "cell: not what snprintf gives", values[i], cell);
    }
  }
}

void check(double value)
{
  for (int digits = 1; digits <= most_digits; ++digits)
  {
    check_digits(value, digits);
  }
  check_shortest(value);
  check_fixed(value);
  check_cells(value);
}

void check_format(std::string_view text)
{
  try
  {
    const NumberFormat format = parse_number_format(text);
    require(parse_number_format(to_text(format)) == format, "a format", 0, std::string(text));
  }
  catch (const FormatError&)
  {
    // what it says is for a reader to judge
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  check_format({ reinterpret_cast<const char*>(data), size });
  constexpr std::size_t most = 8;
  for (std::size_t at = 0; at + 8 <= size && at < 8 * most; at += 8)
  {
    std::int64_t bits = 0;
    std::memcpy(&bits, data + at, sizeof bits);
    check(std::bit_cast<double>(bits));
    check_integer(bits);
    // a number of few digits, which bits seldom are
    const int shift = static_cast<int>(bits & 63);
    const int exponent = static_cast<int>(bits >> 6 & 1023) % 650 - 330;
    const std::string decimal = std::to_string(bits >> shift) + "e" + std::to_string(exponent);
    check(std::strtod(decimal.c_str(), nullptr));
  }
  return 0;
}
