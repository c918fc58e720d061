// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_support_quad_h
#define granular_tests_support_quad_h

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

/// 113 bits: what results are compared with.
#if defined(_WIN32)
#include "../windows/quad.h"
#elif __LDBL_MANT_DIG__ == 113
using Quad = long double; // ARM has these, and no others
#else
__extension__ using Quad = __float128;
#endif

inline Quad absolute(Quad value)
{
  return value < 0 ? -value : value;
}

/// Distance from the double nearest to a value to the next one away from zero.
inline double ulp(Quad value)
{
  const double nearest = std::abs(static_cast<double>(value));
  return std::nextafter(nearest, std::numeric_limits<double>::infinity()) - nearest;
}

/// A value and the sum of the magnitudes of the terms it is the sum of, both as they stand in the
/// fully expanded formula. Products and quotients of sums are expanded.
struct Exact
{
  Quad value = 0;
  Quad terms = 0;

  Exact() = default;
  Exact(double term) // NOLINT: a number is an expression
    : value(term)
    , terms(absolute(value))
  {
  }
  Exact(Quad sum, Quad magnitudes)
    : value(sum)
    , terms(magnitudes)
  {
  }
};

inline Exact operator-(const Exact& a)
{
  return { -a.value, a.terms };
}

inline Exact operator+(const Exact& a, const Exact& b)
{
  return { a.value + b.value, a.terms + b.terms };
}

inline Exact operator-(const Exact& a, const Exact& b)
{
  return a + -b;
}

inline Exact operator*(const Exact& a, const Exact& b)
{
  return { a.value * b.value, a.terms * b.terms };
}

/// The divisor's own terms do not count: it divides each term of the dividend.
inline Exact operator/(const Exact& a, const Exact& b)
{
  return { a.value / b.value, a.terms / absolute(b.value) };
}

/// |result - exact| in units of the bound: ulp(exact) + 2^-100 * sum of |terms|.
inline double error_in_bounds(double result, const Exact& exact)
{
  const Quad bound =
    static_cast<Quad>(ulp(exact.value)) + exact.terms * static_cast<Quad>(0x1p-100);
  return static_cast<double>(absolute(static_cast<Quad>(result) - exact.value) / bound);
}

inline Exact least(std::initializer_list<Exact> values)
{
  return *std::min_element(
    values.begin(), values.end(), [](const Exact& a, const Exact& b) { return a.value < b.value; });
}

inline Exact greatest(std::initializer_list<Exact> values)
{
  return *std::max_element(
    values.begin(), values.end(), [](const Exact& a, const Exact& b) { return a.value < b.value; });
}
#endif
