// SPDX-License-Identifier: BSD-3-Clause
// Doubles as integers: what comparisons and periods are checked with.
#ifndef granular_tests_support_exact_units_h
#define granular_tests_support_exact_units_h

#include <cmath>
#include <stdexcept>

__extension__ using Int128 = __int128;

/// x in units of 2^-unit_bits, exactly; throws where it is no whole number of them, or has more than 120 bits.
constexpr int unit_bits = 80;

inline Int128 to_units(double x)
{
  int exponent = 0;
  const double mantissa = std::ldexp(std::frexp(x, &exponent), 53);
  exponent += unit_bits - 53;
  auto units = static_cast<Int128>(static_cast<long long>(mantissa));
  if (exponent > 120 - 53)
  {
    throw std::range_error("too large for 128 bits");
  }
  for (; exponent > 0; --exponent)
  {
    units *= 2;
  }
  for (; exponent < 0 && units != 0; ++exponent)
  {
    if (units % 2 != 0)
    {
      throw std::range_error("no whole number of units");
    }
    units /= 2;
  }
  return units;
}

/// a / b towards minus infinity; b is not 0.
inline Int128 floor_quotient(Int128 a, Int128 b)
{
  const Int128 quotient = a / b;
  return quotient - ((a % b != 0 && (a < 0) != (b < 0)) ? 1 : 0);
}

/// The image of x in [lo, hi), in units.
inline Int128 image_in(double x, double lo, double hi)
{
  const Int128 period = to_units(hi) - to_units(lo);
  const Int128 offset = to_units(x) - to_units(lo);
  return to_units(x) - floor_quotient(offset, period) * period;
}
#endif
