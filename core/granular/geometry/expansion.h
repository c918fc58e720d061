// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_geometry_expansion_h
#define granular_geometry_expansion_h

#include "granular/geometry/box.h"

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

/// A vector whose components are exact sums of a few doubles.
using ExactVector = std::array<Expansion<8>, 3>;

inline ExactVector exact_vector(const Twofold3& vector) noexcept
{
  ExactVector exact;
  for (std::size_t k = 0; k < 3; ++k)
  {
    exact[k].add(vector[k]);
  }
  return exact;
}

/// Room for six permutations, products of three components, and four terms of each component.
using ExactDeterminant = Expansion<6 * 8 * 2 * 2 * 4>;

/// Returns the exact determinant of three vectors, as long as no product of three components underflows. Components of
/// b and c are sums of at most two doubles.
inline ExactDeterminant determinant(
  const ExactVector& a, const ExactVector& b, const ExactVector& c) noexcept
{
  constexpr std::size_t orders[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 0, 2, 1 },
    { 2, 1, 0 }, { 1, 0, 2 } };
  ExactDeterminant sum;
  for (std::size_t order = 0; order < 6; ++order)
  {
    const auto& [i, j, k] = orders[order];
    const double sign = order < 3 ? 1 : -1;
    for (const double x : a[i].parts())
    {
      for (const double y : b[j].parts())
      {
        const double product = sign * x * y;
        const double rest = std::fma(sign * x, y, -product);
        for (const double z : c[k].parts())
        {
          sum.add_product(rest, z);
          sum.add_product(product, z);
        }
      }
    }
  }
  return sum;
}
}
#endif
