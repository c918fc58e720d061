// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/number_print.h"

#include "granular/base/decimal.h"
#include "granular/base/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

namespace granular
{
namespace
{
__extension__ using Wide = unsigned __int128;

// ---- digits to characters ----------------------------------------------------------------------

constexpr auto whole_powers_of_ten = []
{
  std::array<std::uint64_t, 18> powers{};
  std::uint64_t power = 1;
  for (std::uint64_t& entry : powers)
  {
    entry = power;
    power *= 10;
  }
  return powers;
}();

constexpr std::uint64_t eight_zeros = 0x3030303030303030;

/// The digits of x < 10^8, one a byte, the first one lowest: halves, then quarters, then eighths at
/// once. Reciprocals are exact in their range: x < 10^4 by 100, x < 100 by 10.
inline std::uint64_t eight_digits(std::uint64_t x)
{
  const std::uint64_t high = x * 3518437209 >> 45; // x / 10^4
  const std::uint64_t halves = (x << 32) - high * ((std::uint64_t{ 10000 } << 32) - 1);
  const std::uint64_t hundreds = ((halves * 10486) >> 20) & 0x7f0000007f;
  const std::uint64_t pairs = (halves << 16) - hundreds * ((100 << 16) - 1);
  const std::uint64_t tens = ((pairs * 103) >> 10) & 0x000f000f000f000f;
  return (pairs << 8) - tens * ((10 << 8) - 1);
}

/// How many of eight digits there are up to the last that is not 0; at least one.
inline unsigned significant(std::uint64_t digits)
{
  const std::uint64_t reversed = __builtin_bswap64(digits) | std::uint64_t{ 1 } << 63;
  return 8 - (static_cast<unsigned>(std::countr_zero(reversed)) >> 3);
}

/// The digits of numbers below 1000.
constexpr auto three_digits = []
{
  std::array<std::uint32_t, 1000> table{};
  for (std::uint32_t i = 0; i < table.size(); ++i)
  {
    table[i] = i / 100 | i / 10 % 10 << 8 | i % 10 << 16;
  }
  return table;
}();

/// The same for x < 10^6, and two zeros.
inline std::uint64_t six_digits(std::uint64_t x)
{
  const std::uint64_t high = x * 1073742 >> 30; // x / 1000
  return three_digits[high] | std::uint64_t{ three_digits[x - high * 1000] } << 24;
}

inline void store(char* to, std::uint64_t eight_chars)
{
  static_assert(std::endian::native == std::endian::little);
  std::memcpy(to, &eight_chars, sizeof eight_chars);
}

// ---- where digits, point and exponent stand ----------------------------------------------------

/// Offsets are in characters, from the first after the sign.
struct Layout
{
  std::uint8_t start;    ///< of the digits, after "0.000"
  std::uint8_t shift;    ///< 8 * digits between the first and the point
  std::uint8_t point;    ///< where a point goes, seen or not
  std::uint8_t tail;     ///< where the digits after the point go
  std::uint8_t tail_end; ///< where the last eight of sixteen of them go
  std::uint8_t before;   ///< digits before the point; many: the point is in front of them all
  std::uint8_t least;    ///< digits that are printed even if they are 0
};

constexpr int least_fixed = -4; // %g prints smaller numbers with an exponent

/// By the decimal exponent of a number that is printed without it.
constexpr auto layouts = []
{
  std::array<Layout, 17 - least_fixed> table{};
  for (int k = least_fixed; k <= 16; ++k)
  {
    const auto byte = [](int n) { return static_cast<std::uint8_t>(n); };
    Layout& layout = table[static_cast<std::size_t>(k - least_fixed)];
    if (k < 0) // the tail is printed to where it is anyway
    {
      layout = { byte(1 - k), 0, 1, byte(2 - k), byte(10 - k), 255, 0 };
    }
    else if (k < 16)
    {
      // of the last eight digits none is seen where there is no room for them
      layout = { 0, byte(8 * k), byte(k + 1), byte(k + 2), byte(k < 8 ? k + 10 : 17), byte(k + 1),
        byte(k + 1) };
    }
    else // 17 digits and no point
    {
      layout = { 0, 0, 17, 1, 9, 17, 17 };
    }
  }
  return table;
}();

constexpr int smallest_exponent = -324;

/// "e-05" in the lower bytes, its length in the highest one. First that of no exponent: nothing.
constexpr auto exponents = []
{
  std::array<std::uint64_t, 2 + largest_power - smallest_exponent> table{};
  for (int k = smallest_exponent; k <= largest_power; ++k)
  {
    const auto size = static_cast<unsigned>(k < 0 ? -k : k);
    std::uint64_t text = 'e' | (k < 0 ? '-' : '+') << 8;
    int length = 2;
    for (unsigned unit = size >= 100 ? 100 : 10; unit > 0; unit /= 10, ++length)
    {
      text |= std::uint64_t{ '0' + size / unit % 10 } << (8 * length);
    }
    table[static_cast<std::size_t>(k - smallest_exponent + 1)] =
      text | static_cast<std::uint64_t>(length) << 56;
  }
  return table;
}();

struct Place
{
  const Layout& layout;
  std::uint64_t exponent;
};

/// Where a number stands whose first digit is times 10^k.
inline Place place_of(int k, bool fixed)
{
  return { layouts[static_cast<std::size_t>((fixed ? k : 0) - least_fixed)],
    exponents[fixed ? 0 : static_cast<std::size_t>(k - smallest_exponent + 1)] };
}

/// What is around the digits, of which so many are not zeros at the end.
inline char* finish(char* to, const Place& place, unsigned length)
{
  to[place.layout.point] = '.';
  length += length > place.layout.before ? 1 : 0;
  length = length > place.layout.least ? length : place.layout.least;
  char* const end = to + place.layout.start + length;
  store(end, place.exponent);
  return end + (place.exponent >> 56);
}

constexpr std::uint64_t zeros_and_point = '0' | '.' << 8 | eight_zeros << 16;

/// Eight digits.
inline char* lay_out_eight(char* to, std::uint64_t raw, const Place& place)
{
  store(to, zeros_and_point);
  store(to + place.layout.start, raw | eight_zeros);
  store(to + place.layout.tail, (raw | eight_zeros) >> 8 >> place.layout.shift);
  return finish(to, place, significant(raw));
}

/// Seventeen digits: one, and twice eight.
struct Seventeen
{
  std::uint64_t first;
  std::uint64_t high;
  std::uint64_t low;

  unsigned length() const
  {
    const unsigned upper = high != 0 ? 1 + significant(high) : 1;
    return low != 0 ? 9 + significant(low) : upper;
  }
};

inline Seventeen seventeen_digits(std::uint64_t x)
{
  const std::uint64_t first = x / 10'000'000'000'000'000;
  const std::uint64_t after = x - first * 10'000'000'000'000'000;
  const std::uint64_t half = after / 100'000'000;
  return { first, eight_digits(half), eight_digits(after - half * 100'000'000) };
}

inline char* lay_out_seventeen(char* to, const Seventeen& raw, const Place& place)
{
  const std::uint64_t high = raw.high | eight_zeros;
  const std::uint64_t low = raw.low | eight_zeros;
  store(to, zeros_and_point);
  char* const start = to + place.layout.start;
  *start = static_cast<char>('0' + raw.first);
  store(start + 1, high);
  store(start + 9, low);
  const Wide tail = (Wide{ low } << 64 | high) >> place.layout.shift;
  store(to + place.layout.tail_end, static_cast<std::uint64_t>(tail >> 64));
  store(to + place.layout.tail, static_cast<std::uint64_t>(tail));
  return finish(to, place, raw.length());
}

// ---- values to digits --------------------------------------------------------------------------

/// Left to the library, which is exact and slow.
[[gnu::noinline]] char* print_exactly(char* to, double value, int digits) noexcept
{
  char* const last = to + most_number_chars;
  return digits == 0 ? std::to_chars(to, last, value).ptr
                     : std::to_chars(to, last, value, std::chars_format::general, digits).ptr;
}

constexpr std::uint64_t sign_bit = std::uint64_t{ 1 } << 63;

inline const PowerOfFive& power_of_five(int q)
{
  return powers_of_five[static_cast<std::size_t>(q - smallest_power)];
}

inline std::uint64_t odd_part(std::uint64_t n)
{
  return n >> std::countr_zero(n);
}

enum class Rounding : std::uint8_t
{
  Down,
  Up,
  Unknown
};

/// Whether mantissa * 10^q, of which 64 bits are too near to a half, is rounded up. floor is the
/// number before the point, shift the bits after it in the high half of the product.
Rounding round_half(std::uint64_t mantissa, int q, int shift, std::uint64_t floor) noexcept
{
  const PowerOfFive& five = power_of_five(q);
  const Wide first = Wide{ mantissa } * five.high;
  const Wide product = first + (Wide{ mantissa } * five.low >> 64);
  const Wide half = Wide{ 1 } << (63 + shift);
  const Wide rest = product & ((half << 1) - 1);
  bool is_half = false;
  if (q >= 0 && q <= 27)
  {
    is_half = rest == half; // the product is exact
  }
  else if (rest + 2 - half <= 4)
  {
    // It is a half only if 5^-q divides the mantissa. And if it does, it is one: the quotient is a
    // multiple of a power of two far above this distance.
    if (q > 0 || q < -27 || mantissa % odd_part(power_of_five(-q).high) != 0)
    {
      return Rounding::Unknown;
    }
    is_half = true;
  }
  return is_half  ? (floor & 1) != 0 ? Rounding::Up : Rounding::Down
    : rest > half ? Rounding::Up
                  : Rounding::Down;
}

/// A double times 10^q, as a product of which 64 bits are known.
struct Scaled
{
  std::uint64_t mantissa;
  std::uint64_t product; ///< the bits; the last `shift` of them, 7 to 63, are after the point
  int shift;             ///< modulo 64
  int q;
};

/// A magnitude, not 0 and not small, made to have so many digits before the point.
///
/// With 10^q = g * 2^(binary_exponent(q) - 63), high of the table is in (g - 1, g + 2^-64]. So the
/// product is less than 2 below that of g, and not above it by 2^-63: a fraction of half - 1 or
/// half may be on either side of a half, or on it; all others are on their own.
inline Scaled scale(std::uint64_t magnitude, int digits)
{
  const std::uint64_t mantissa = magnitude << 11 | std::uint64_t{ 1 } << 63;
  const auto biased = static_cast<std::int64_t>(magnitude >> 52);
  constexpr std::int64_t log = 1292913986; // of 2, times 2^32
  const auto least = static_cast<std::int64_t>((biased * log - 1023 * log) >> 32);
  const std::int64_t q = digits - 1 - least -
    static_cast<std::int64_t>(
      magnitude >= least_doubles[static_cast<std::size_t>(least + 1 - smallest_normal_power)]);
  const Wide product =
    Wide{ mantissa } * powers_of_five[static_cast<std::size_t>(q - smallest_power)].high;
  return { mantissa, static_cast<std::uint64_t>(product >> 64),
    62 + 1023 - static_cast<int>(biased) - binary_exponent(static_cast<int>(q)),
    static_cast<int>(q) };
}

inline std::uint64_t whole_power_of_ten(int q)
{
  return whole_powers_of_ten[static_cast<std::size_t>(q)];
}

/// %g's choice.
inline Place place_of_digits(int k, int digits)
{
  return place_of(k, k >= least_fixed && k < digits);
}

/// Any digits from 1 to 17.
[[gnu::noinline]] char* print_many(char* to, double value, int digits) noexcept
{
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const Scaled scaled = scale(bits & ~sign_bit, digits);
  const std::uint64_t floor = scaled.product >> scaled.shift;
  const std::uint64_t half = std::uint64_t{ 1 } << (scaled.shift - 1);
  const std::uint64_t rest = scaled.product & (2 * half - 1);
  std::uint64_t whole = floor + (rest >= half ? 1 : 0);
  if (rest + 1 - half <= 1) [[unlikely]]
  {
    const Rounding rounding = round_half(scaled.mantissa, scaled.q, scaled.shift, floor);
    if (rounding == Rounding::Unknown)
    {
      return print_exactly(to, value, digits);
    }
    whole = floor + (rounding == Rounding::Up ? 1 : 0);
  }
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

/// The shortest number that reads back.
///
/// A decimal of at most 15 digits is what its nearest double gives rounded to 15 digits. So one
/// that reads back as the value is found by that rounding, and with the zeros at its end taken
/// off it is the shortest. It is at most half a unit of the mantissa away, 1/8 of the last digit.
[[gnu::noinline]] char* print_shortest(char* to, double value) noexcept
{
  constexpr int digits = 15;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const Scaled scaled = scale(bits & ~sign_bit, digits);
  const std::uint64_t eighth = std::uint64_t{ 1 } << (scaled.shift - 3);
  const std::uint64_t whole = (scaled.product + eighth) >> scaled.shift;
  const int k = digits - 1 - scaled.q;
  double back = 0;
  if (((scaled.product + eighth) & (8 * eighth - 1)) > 2 * eighth || k >= digits ||
    whole >= whole_power_of_ten(digits) || !to_double(whole, -scaled.q, back) ||
    back != std::abs(value))
  {
    return print_exactly(to, value, 0);
  }
  const Seventeen raw = seventeen_digits(whole * 100);
  const int length = static_cast<int>(raw.length());
  const int point = length > 1 ? 1 : 0;
  const int scientific = length + point + (k <= -100 ? 5 : 4);
  const int fixed = k < 0 ? length + 1 - k : std::max(length + (length > k + 1 ? 1 : 0), k + 1);
  *to = '-';
  return lay_out_seventeen(to + (bits >> 63), raw, place_of(k, fixed <= scientific));
}

/// At most six digits, so that there are at least 44 bits after the point.
inline char* print_few(char* to, double value, int digits) noexcept
{
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const Scaled scaled = scale(bits & ~sign_bit, digits);
  const std::uint64_t fraction = scaled.product << (-scaled.shift & 63);
  constexpr std::uint64_t doubt = std::uint64_t{ 1 } << 30; // much more than 2 units of the product
  if (fraction + doubt - (std::uint64_t{ 1 } << 63) < 2 * doubt) [[unlikely]]
  {
    return print_many(to, value, digits);
  }
  std::uint64_t whole = (scaled.product >> (scaled.shift & 63)) + (fraction >> 63);
  whole *= whole_power_of_ten(6 - digits);
  int k = digits - 1 - scaled.q;
  if (whole == 1'000'000) [[unlikely]]
  {
    whole = 100'000;
    ++k;
  }
  *to = '-';
  return lay_out_eight(to + (bits >> 63), six_digits(whole), place_of_digits(k, digits));
}

/// x < 10^8 does it in one go.
inline char* print_natural(char* to, std::uint64_t x) noexcept
{
  if (x < 10)
  {
    *to = static_cast<char>('0' + x);
    return to + 1;
  }
  if (x < 100'000'000)
  {
    const std::uint64_t digits = eight_digits(x);
    const int zeros = std::countr_zero(digits) & ~7;
    store(to, (digits | eight_zeros) >> zeros);
    return to + 8 - (zeros >> 3);
  }
  to = print_natural(to, x / 100'000'000);
  store(to, eight_digits(x % 100'000'000) | eight_zeros);
  return to + 8;
}
}

NumberFormat parse_number_format(std::string_view text)
{
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
    "expected %g, %.Ng with N from 1 to 17, or shortest, got '" + std::string(text) + "'");
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
  constexpr std::uint64_t least = 60; // 2^-963: 10^q is in the table
  if ((bits >> 52 & 2047) - least >= 2047 - least) [[unlikely]]
  {
    return print_exactly(to, value, format.digits);
  }
  if (format.digits == 6) [[likely]] // known to the compiler
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

char* print_integer(char* to, std::int64_t value) noexcept
{
  const auto bits = static_cast<std::uint64_t>(value);
  *to = '-';
  return value < 0 ? print_natural(to + 1, 0 - bits) : print_natural(to, bits);
}
}
