// SPDX-License-Identifier: BSD-3-Clause
#include "granular/numbers/number_print.h"

#include "granular/common/error.h"
#include "granular/numbers/decimal.h"
#include "granular/numbers/number.h"
#include "granular/numbers/number_print_few.h"
#include "granular/numbers/number_print_layout.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <system_error>

namespace granular
{
namespace
{
using namespace number_print;

/// Left to the library, which is exact and slow.
[[gnu::noinline]] char* print_exactly(char* to, double value, int digits) noexcept
{
  char* const last = to + most_number_chars;
  return digits == 0 ? std::to_chars(to, last, value).ptr
                     : std::to_chars(to, last, value, std::chars_format::general, digits).ptr;
}

/// Any digits from 1 to 17.
[[gnu::noinline]] char* print_many(char* to, double value, int digits) noexcept
{
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const Scaled scaled = scale(bits & ~sign_bit, digits);
  const std::uint64_t floor = scaled.product >> scaled.shift;
  const std::uint64_t half = std::uint64_t{ 1 } << (scaled.shift - 1);
  const std::uint64_t rest = scaled.product & (2 * half - 1);
  bool up = rest >= half;
  if (rest + 1 - half <= 1) [[unlikely]]
  {
    // 64 bits are too near to a half; of 128 the error is less than two units
    const PowerOfFive& five = power_of_five(scaled.q);
    const Wide product =
      Wide{ scaled.mantissa } * five.high + (Wide{ scaled.mantissa } * five.low >> 64);
    const Wide middle = Wide{ half } << 64;
    const Wide behind = product & (2 * middle - 1);
    if (behind + 2 - middle <= 4)
    {
      return print_exactly(to, value, digits); // mostly of a number that is a half
    }
    up = behind > middle;
  }
  std::uint64_t whole = floor + (up ? 1 : 0);
  int k = digits - 1 - scaled.q;
  if (whole == whole_power_of_ten(digits)) [[unlikely]]
  {
    whole = whole_power_of_ten(digits - 1);
    ++k;
  }
  *to = '-';
  return lay_out_seventeen(to + (bits >> 63),
    seventeen_digits(whole * whole_power_of_ten(17 - digits)), place_of_digits(k, digits));
}

/// The high 64 bits of g * x / 2^64, with the lowest bit set if there is more below than the error of g: enough to compare it with
/// whole numbers.
inline std::uint64_t multiply_to_odd(const PowerOfFive& g, std::uint64_t x)
{
  const Wide product = Wide{ g.high } * x + static_cast<std::uint64_t>(Wide{ g.low } * x >> 64);
  return static_cast<std::uint64_t>(product >> 64) |
    std::uint64_t{ static_cast<std::uint64_t>(product) > 1 };
}

/// Seventeen digits, of which those at the end may be 0.
struct Shortest
{
  std::uint64_t whole; ///< the digits
  int k;               ///< the first of them is times 10^k
};

/// digits * 10^k with 16 or 17 digits.
inline Shortest seventeen_of(std::uint64_t digits, int k)
{
  const bool all = digits >= whole_power_of_ten(16);
  return { all ? digits : digits * 10, k + (all ? 16 : 15) };
}

/// The shortest decimal that reads back as a magnitude, not 0 and not small; of several the nearest. R. Giulietti, "The Schubfach
/// way to render doubles", 2020: with the largest power 10^k that is not above the distance of two doubles, the interval that is read
/// as the number holds a multiple of it, and at most one of 10^(k+1). Everything is four times as large, for halves of an ulp.
inline Shortest shortest_digits(std::uint64_t magnitude)
{
  constexpr int largest_exact = 55; // power of five of 128 bits
  constexpr std::uint64_t hidden = std::uint64_t{ 1 } << 52;
  const std::uint64_t fraction = magnitude & (hidden - 1);
  const auto exponent = static_cast<int>(magnitude >> 52) - 1075;
  const bool closer = fraction == 0; // the double below is half as far away
  // floor(log10(2^exponent)), or of 3/4 of it; times 2^22
  const int k = (exponent * 1262611 - (closer ? 524031 : 0)) >> 22;
  PowerOfFive g = power_of_five(-k);
  g.low += -k > largest_exact ? 1 : 0; // not below the true value
  const int shift = exponent + binary_exponent(-k) + 1;
  const std::uint64_t four = (fraction | hidden) << 2;
  const std::uint64_t value = multiply_to_odd(g, four << shift);
  const std::uint64_t odd =
    fraction & 1; // then the ends of the interval are read as its neighbours
  const std::uint64_t low = multiply_to_odd(g, (four - (closer ? 1 : 2)) << shift) + odd;
  const std::uint64_t high = multiply_to_odd(g, (four + 2) << shift) - odd;
  const std::uint64_t floor = value >> 2;
  const std::uint64_t tens = floor / 10;
  const bool tens_fit = low <= 40 * tens;
  const bool next_tens_fit = 40 * tens + 40 <= high;
  if (tens_fit != next_tens_fit)
  {
    return seventeen_of((tens + (next_tens_fit ? 1 : 0)) * 10, k);
  }
  const bool floor_fits = low <= 4 * floor;
  const bool next_fits = 4 * floor + 4 <= high;
  const std::uint64_t rest = value - 4 * floor;
  const bool nearer_up = rest > 2 || (rest == 2 && (floor & 1) != 0);
  const bool up = floor_fits != next_fits ? next_fits : nearer_up;
  return seventeen_of(floor + (up ? 1 : 0), k);
}

/// The shortest number that reads back, not 0 and not small.
[[gnu::noinline]] char* print_shortest(char* to, double value) noexcept
{
  // std::to_chars prints integers between all their digits, not zeros behind the shortest ones
  constexpr int most_padded = 15;
  constexpr int least_far = 22;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const Shortest found = shortest_digits(bits & ~sign_bit);
  const int k = found.k;
  if (k > most_padded && k < least_far)
  {
    return print_exactly(to, value, 0);
  }
  const Seventeen raw = seventeen_digits(found.whole);
  const int length = static_cast<int>(raw.length());
  const int point = length > 1 ? 1 : 0;
  const int scientific = length + point + (k <= -100 || k >= 100 ? 5 : 4);
  const int fixed = k < 0 ? length + 1 - k : std::max(length + (length > k + 1 ? 1 : 0), k + 1);
  *to = '-';
  return lay_out_seventeen(to + (bits >> 63), raw, place_of(k, fixed <= scientific));
}

/// So many digits where they read back as the same number. Slow.
[[gnu::noinline]] char* print_checked(char* to, double value, int digits) noexcept
{
  char* const end = print_exactly(to, value, digits);
  double back = 0;
  return parse_double(to, end, back) && back == value ? end : print_exactly(to, value, 0);
}

/// The same for 1 to 15 digits of a number that is not 0 and not small: no other decimal of 15 digits reads back.
[[gnu::noinline]] char* print_at_least(char* to, double value, int least) noexcept
{
  constexpr int most = 15;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const Shortest found = shortest_digits(bits & ~sign_bit);
  if (found.k >= most)
  {
    return print_checked(to, value, least);
  }
  const Seventeen raw = seventeen_digits(found.whole);
  const auto length = static_cast<int>(raw.length());
  if (length > most)
  {
    return print_shortest(to, value);
  }
  *to = '-';
  return lay_out_seventeen(
    to + (bits >> 63), raw, place_of_digits(found.k, std::max(least, length)));
}

inline char* print_few(char* to, double value, int digits) noexcept
{
  const Rounded rounded = round_few(std::bit_cast<std::uint64_t>(value) & ~sign_bit, digits);
  if (!rounded.sure) [[unlikely]]
  {
    return print_many(to, value, digits);
  }
  return lay_out_few(to, value, rounded, digits);
}

/// At least so many digits, up to six, and more where they do not read back as the same number.
inline char* print_few_or_more(char* to, double value, int digits) noexcept
{
  const Rounded rounded = round_few(std::bit_cast<std::uint64_t>(value) & ~sign_bit, digits);
  double back = 0;
  return to_double(rounded.whole, -rounded.q, back) && back == std::abs(value)
    ? lay_out_few(to, value, rounded, digits)
    : print_at_least(to, value, digits);
}
}

char* print_number(char* to, double value, NumberFormat format) noexcept
{
  const auto bits = std::bit_cast<std::uint64_t>(value);
  if (bits << 1 == 0)
  {
    to[0] = '-';
    to += bits >> 63;
    to[0] = '0';
    return to + 1;
  }
  if (!is_usual(bits & ~sign_bit)) [[unlikely]]
  {
    return format.exact ? print_checked(to, value, format.digits)
                        : print_exactly(to, value, format.digits);
  }
  if (format.exact && format.digits > 0 && format.digits < 17)
  {
    constexpr int few = 6;
    constexpr int most = 15; // that any double of as many digits is the only one of
    return format.digits <= few ? print_few_or_more(to, value, format.digits)
      : format.digits <= most   ? print_at_least(to, value, format.digits)
                                : print_checked(to, value, format.digits);
  }
  if (format.digits == 6) [[likely]] // a case of its own: what the compiler knows is faster
  {
    return print_few(to, value, 6);
  }
  if (format.digits == 0)
  {
    return print_shortest(to, value);
  }
  return format.digits < 6 ? print_few(to, value, format.digits)
                           : print_many(to, value, format.digits);
}

double as_fixed(double value) noexcept
{
  std::array<char, most_fixed_chars> word;
  static_cast<void>(parse_double(word.data(), print_fixed(word.data(), value), value));
  return value;
}

double as_printed(double value, NumberFormat format) noexcept
{
  const std::uint64_t magnitude = std::bit_cast<std::uint64_t>(value) & ~sign_bit;
  constexpr int few = 6;
  if (magnitude != 0 && is_usual(magnitude) && format.digits > 0 && format.digits <= few &&
    !format.exact)
  {
    const Rounded rounded = round_few(magnitude, format.digits);
    double back = 0;
    if (rounded.sure && to_double(rounded.whole, -rounded.q, back))
    {
      return std::copysign(back, value);
    }
  }
  char word[most_number_chars];
  static_cast<void>(parse_double(word, print_number(word, value, format), value));
  return value;
}

std::string to_text(double value, NumberFormat format)
{
  char word[most_number_chars];
  return { word, print_number(word, value, format) };
}

char* print_fixed(char* to, double value) noexcept
{
  return std::to_chars(to, to + most_fixed_chars, value, std::chars_format::fixed, 6).ptr;
}

NumberFormat parse_number_format(std::string_view text)
{
  if (text == "Automatic")
  {
    return automatic_numbers;
  }
  if (text == "%g")
  {
    return { 6 };
  }
  if (text == "shortest")
  {
    return { 0 };
  }
  if (text.size() >= 4 && text.starts_with("%.") && text.ends_with('g'))
  {
    const std::string_view number = text.substr(2, text.size() - 3);
    int digits = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), digits);
    if (error == std::errc{} && end == number.data() + number.size() && number[0] != '0' &&
      digits >= 1 && digits <= 17)
    {
      return { digits };
    }
  }
  throw FormatError(
    "expected a number format of Automatic, %g, %.Ng with N from 1 to 17, or shortest, got '" +
    std::string(text) + "'");
}

std::string to_text(NumberFormat format)
{
  return format == automatic_numbers ? "Automatic"
    : format.digits == 0             ? "shortest"
    : format.digits == 6             ? "%g"
                                     : "%." + std::to_string(format.digits) + "g";
}
}
