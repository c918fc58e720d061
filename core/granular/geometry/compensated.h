// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_geometry_compensated_h
#define granular_geometry_compensated_h

#include <cmath>

namespace granular
{
/// Adds a term to a sum, and returns what its rounding loses, exactly.
inline double add_exactly(double& sum, double term) noexcept
{
  const double before = sum;
  sum = before + term;
  const double part = sum - before;
  return (before - (sum - part)) + (term - part);
}

/// The unevaluated sum hi + lo of two doubles: about 106 bits.
struct Twofold
{
  double hi = 0;
  double lo = 0;

  double value() const noexcept { return hi + lo; }
  Twofold operator-() const noexcept { return { -hi, -lo }; }
};

/// A sum of doubles and products that keeps what each rounding loses (T. Ogita, S. M. Rump,
/// S. Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26, 2005: algorithm Dot2).
/// For n terms the error of value() is at most half an ulp of the exact sum plus about
/// n^2 * 2^-106 times the sum of the terms' magnitudes. No over- or underflow of products assumed.
struct CompensatedSum
{
  double hi = 0;
  double lo = 0;

  void add(double term) noexcept { lo += add_exactly(hi, term); }

  void add(Twofold term) noexcept
  {
    this->add(term.hi);
    lo += term.lo;
  }

  void add_product(double a, double b) noexcept
  {
    const double product = a * b;
    this->add(product);
    lo += std::fma(a, b, -product);
  }

  void add_product(double a, Twofold b) noexcept
  {
    this->add_product(a, b.hi);
    lo += a * b.lo;
  }

  void add_product(Twofold a, Twofold b) noexcept
  {
    this->add_product(a.hi, b);
    lo += a.lo * b.hi;
  }

  /// Handles a sum that has overflowed: lo means nothing then, only hi gives the sign.
  double value() const noexcept { return std::isfinite(hi) ? hi + lo : hi; }

  /// Returns value() with the bits below it, too.
  Twofold twofold() const noexcept
  {
    if (!std::isfinite(hi))
    {
      return { hi, 0 };
    }
    const double sum = hi + lo;
    return { sum, lo - (sum - hi) };
  }

  /// Returns the sum divided by b.
  Twofold over(Twofold b) const noexcept
  {
    const Twofold a = this->twofold();
    const double quotient = a.hi / b.hi;
    if (!std::isfinite(quotient) || !std::isfinite(b.hi))
    {
      return { quotient, 0 };
    }
    const double rest = std::fma(-quotient, b.hi, a.hi) + a.lo - quotient * b.lo;
    return { quotient, rest / b.hi };
  }
};
}
#endif
