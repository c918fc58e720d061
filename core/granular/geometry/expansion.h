// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_geometry_expansion_h
#define granular_geometry_expansion_h

#include "granular/geometry/compensated.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace granular
{
/// Returns the largest double not above a sum whose nearest double is hi.
inline double floor_of(Twofold sum) noexcept
{
  return sum.lo < 0 ? std::nextafter(sum.hi, -HUGE_VAL) : sum.hi;
}

/// An exact sum of at most that many doubles, as doubles that do not overlap (J. R. Shewchuk, "Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates", Discrete Comput. Geom. 18, 1997). No overflow, and no
/// underflow of products, assumed.
template <std::size_t most>
class Expansion
{
public:
  void add(double term) noexcept
  {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i)
    {
      const double rest = add_exactly(term, parts_[i]);
      parts_[kept] = rest;
      kept += rest != 0 ? 1 : 0;
    }
    parts_[kept] = term;
    size_ = kept + (term != 0 ? 1 : 0);
  }

  void add(Twofold term) noexcept
  {
    this->add(term.hi);
    this->add(term.lo);
  }

  /// Sets the sum of two terms.
  void add_product(double a, double b) noexcept
  {
    const double product = a * b;
    this->add(std::fma(a, b, -product));
    this->add(product);
  }

  /// Sets the sum of four terms.
  void add_product(double a, Twofold b) noexcept
  {
    this->add_product(a, b.lo);
    this->add_product(a, b.hi);
  }

  /// Returns the sign: -1, 0 or 1.
  int sign() const noexcept { return size_ == 0 ? 0 : parts_[size_ - 1] > 0 ? 1 : -1; }

  /// Returns the largest double not above the sum: it is below another double exactly if the sum is.
  double floor() const noexcept
  {
    double sum = 0;
    for (std::size_t i = size_; i-- > 0;)
    {
      const double next = sum + parts_[i];
      const double rest = parts_[i] - (next - sum);
      sum = next;
      if (rest != 0)
      {
        return floor_of({ sum, rest });
      }
    }
    return sum;
  }

  /// Returns the nearest double, halfway between two the even one.
  double rounded() const noexcept
  {
    double sum = 0;
    double rest = 0;
    std::size_t i = size_;
    while (i > 0 && rest == 0)
    {
      rest = add_exactly(sum, parts_[--i]);
    }
    // halfway between two doubles: what is left decides
    if (i > 0 && (rest > 0) == (parts_[i - 1] > 0))
    {
      const double other = sum + 2 * rest;
      sum = other - sum == 2 * rest ? other : sum;
    }
    return sum;
  }

  /// Returns the sum to 106 bits; lo is 0 if hi is exact.
  Twofold twofold() const noexcept
  {
    Twofold sum;
    for (std::size_t i = size_; i-- > 0;)
    {
      const double next = sum.hi + parts_[i];
      sum.lo += parts_[i] - (next - sum.hi);
      sum.hi = next;
    }
    return sum;
  }

  /// Returns the doubles whose sum it is, the smallest first.
  std::span<const double> parts() const noexcept { return { parts_.data(), size_ }; }

private:
  std::array<double, most> parts_;
  std::size_t size_ = 0;
};
}
#endif
