// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_geometry_reproducible_sum_h
#define granular_geometry_reproducible_sum_h

#include "granular/common/simd.h"
#include "granular/geometry/expansion.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace granular
{
/// Sums that do not depend on the order of their terms. A term is cut into pieces, the highest first: whole multiples of
/// powers of two that are the same for all terms. Pieces of one level are added as 64-bit integers, which is exact, so
/// order, threads and ranks cannot matter, and integers of several sums may be added. A piece is cut off by adding a number
/// so large that the sum has no bits below the level, as in the indexed sums of J. Demmel and H. D. Nguyen
/// ("Parallel reproducible summation", IEEE Trans. Comput. 64, 2015), which here keep all levels and add without rounding.
///
/// Eight sums are made at once.
class SumScale
{
public:
  static constexpr std::size_t lanes = 8;

  /// The known bounds of the terms of a sum: magnitudes are below 2^top, and significant parts are multiples of 2^bottom.
  /// Each term is rounded to one, which does not change such multiples.
  struct Range
  {
    int top = 0;
    int bottom = 0;
  };

  /// terms: the largest number in one sum, at most 2^40. Tops are at most 900: terms are below 8e270.
  SumScale(const std::array<Range, lanes>& ranges, std::int64_t terms);

  std::size_t levels() const noexcept { return shifts_.size(); }

  /// Returns the 64-bit integers of the eight sums.
  std::size_t size() const noexcept { return lanes * shifts_.size(); }

  using Terms = std::array<double, lanes>;

  /// Adds a term to each of the sums of a cell, for each of the cells; sums without a term get 0. The sums of cell c are at
  /// sums + c size().
  void add(std::span<const Terms> terms, const std::int64_t* cells, std::int64_t* sums,
    Simd simd = best_simd()) const noexcept;

  /// Returns the eight sums, each correctly rounded.
  Terms values(const std::int64_t* sums) const noexcept;

private:
  double value(const std::int64_t* sums, std::size_t lane) const noexcept;

  std::vector<Terms> shifts_; ///< of each level and sum: 1.5 * 2^(52 + e), for multiples of 2^e
  std::array<int, lanes> top_ = {};
  int width_; ///< bits of a level
};

/// Several sums of doubles, each of which comes out correctly rounded, so that the order of the terms cannot matter. What
/// additions lose is added up in a second double, and what these additions lose is bounded in a third (the cascade of
/// T. Ogita, S. M. Rump, S. Oishi, "Accurate sum and dot product", SIAM J. Sci. Comput. 26, 2005, with a test whether the
/// bound can change the rounding). Where it can, round() says so, and the terms have to be added once more, exactly: see
/// ExactSum. Terms are finite and below 2^900.
template <std::size_t most>
class RoundedSums
{
public:
  /// Adds a term to each sum.
  void add(std::span<const double, most> terms) noexcept
  {
    for (std::size_t i = 0; i < most; ++i)
    {
      const double lost = add_exactly(high_[i], terms[i]);
      rest_[i] += std::abs(add_exactly(low_[i], lost));
    }
  }

  /// Stores the correctly rounded sum. Returns false if that needs the terms again.
  bool round(std::size_t i, double& sum) const noexcept
  {
    sum = high_[i];
    const double beyond = add_exactly(sum, low_[i]);
    if (rest_[i] == 0)
    {
      return true;
    }
    // a little more than there is, for its own rounding, and so that halfway between two doubles is not taken for a side
    const double rest =
      rest_[i] * (1 + 0x1p-20) + std::abs(beyond) * 0x1p-51 + std::numeric_limits<double>::min();
    return sum + (beyond + rest) == sum && sum + (beyond - rest) == sum;
  }

private:
  std::array<double, most> high_ = {};
  std::array<double, most> low_ = {};
  std::array<double, most> rest_ = {};
};

/// An exact sum of any number of doubles, for the few that RoundedSums cannot round: it has room for all bits that there are
/// between 2^-1074 and 2^960.
using ExactSum = Expansion<2048>;
}
#endif
