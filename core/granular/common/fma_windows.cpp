// SPDX-License-Identifier: BSD-3-Clause
// fma of the C library of MinGW, which std::fma calls, rounds twice: exact products need one that rounds once. This one takes its
// place where the library is linked.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <immintrin.h>

namespace
{
using Wide = unsigned __int128;

constexpr int fraction_bits = 52;
constexpr int least_exponent = -1074; // of the last bit of a double
constexpr int top = 126;              // bits of an operand of the sum: one is left for the carry

/// A finite number that is not 0: fraction * 2^exponent.
struct Parts
{
  std::uint64_t fraction;
  int exponent;
};

Parts parts_of(double x) noexcept
{
  constexpr std::uint64_t hidden = std::uint64_t{ 1 } << fraction_bits;
  constexpr int exponents = 0x7ff;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int exponent = static_cast<int>(bits >> fraction_bits) & exponents;
  const std::uint64_t fraction = bits & (hidden - 1);
  return exponent == 0 ? Parts{ fraction, least_exponent }
                       : Parts{ fraction | hidden, exponent - 1 + least_exponent };
}

int bits_of(Wide x) noexcept
{
  const auto high = static_cast<std::uint64_t>(x >> 64);
  return 128 -
    (high != 0 ? std::countl_zero(high) : 64 + std::countl_zero(static_cast<std::uint64_t>(x)));
}

/// Shifts bits out. The last bit that stays tells whether any of them was set.
Wide shift_out(Wide x, int bits) noexcept
{
  if (bits >= top + 2)
  {
    return x != 0 ? 1 : 0;
  }
  const Wide kept = x >> bits;
  return (kept << bits) != x ? kept | 1 : kept;
}

/// Rounds fraction * 2^exponent to the nearest double, ties to even. A fraction with bits out of sight has many bits.
double round_once(Wide fraction, int exponent) noexcept
{
  const int drop =
    std::max({ bits_of(fraction) - fraction_bits - 1, least_exponent - exponent, 0 });
  Wide kept = fraction;
  if (drop > 0)
  {
    // two bits more: the half, and anything below it
    const Wide rest = drop > 2 ? shift_out(fraction, drop - 2) : fraction << (2 - drop);
    kept = (rest >> 2) + ((rest & 3) + ((rest >> 2) & 1) > 2 ? 1 : 0);
  }
  return std::ldexp(
    static_cast<double>(static_cast<std::uint64_t>(kept)), exponent + drop); // exact
}

double add_product(double a, double b, double c) noexcept
{
  const Parts x = parts_of(a);
  const Parts y = parts_of(b);
  Wide product = Wide{ x.fraction } * y.fraction;
  const bool negative = std::signbit(a) != std::signbit(b);
  int of_product = x.exponent + y.exponent;
  if (c == 0)
  {
    const double result = round_once(product, of_product);
    return negative ? -result : result;
  }
  const Parts z = parts_of(c);
  // both with the same first bit; then the smaller one moves down
  const int up = top - bits_of(product);
  product <<= up;
  of_product -= up;
  const int up_term = top - bits_of(z.fraction);
  Wide term = Wide{ z.fraction } << up_term;
  int of_term = z.exponent - up_term;
  const int common = std::max(of_product, of_term);
  product = shift_out(product, common - of_product);
  term = shift_out(term, common - of_term);
  if (negative == std::signbit(c))
  {
    const double result = round_once(product + term, common);
    return negative ? -result : result;
  }
  if (product == term)
  {
    return 0;
  }
  const double result = round_once(product > term ? product - term : term - product, common);
  return (product > term) == negative ? -result : result;
}

__attribute__((target("fma"))) double by_instruction(double a, double b, double c) noexcept
{
  return _mm_cvtsd_f64(_mm_fmadd_sd(_mm_set_sd(a), _mm_set_sd(b), _mm_set_sd(c)));
}
}

extern "C" double fma(double a, double b, double c)
{
  static const bool has_instruction = __builtin_cpu_supports("fma");
  if (has_instruction)
  {
    return by_instruction(a, b, c);
  }
  if (a == 0 || b == 0 || !std::isfinite(a) || !std::isfinite(b))
  {
    return a * b + c; // the product is exact
  }
  return std::isfinite(c) ? add_product(a, b, c) : c;
}
