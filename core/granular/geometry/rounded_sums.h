// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_geometry_rounded_sums_h
#define granular_geometry_rounded_sums_h

#include "granular/geometry/expansion.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace granular
{
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
      const double lost = RoundedSums::add(high_[i], terms[i]);
      rest_[i] += std::abs(RoundedSums::add(low_[i], lost));
    }
  }

  /// Stores the correctly rounded sum. Returns false if that needs the terms again.
  bool round(std::size_t i, double& sum) const noexcept
  {
    sum = high_[i];
    const double beyond = RoundedSums::add(sum, low_[i]);
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
  /// Adds a term, and returns what the addition loses.
  static double add(double& sum, double term) noexcept
  {
    const double before = sum;
    sum = before + term;
    const double part = sum - before;
    return (before - (sum - part)) + (term - part);
  }

  std::array<double, most> high_ = {};
  std::array<double, most> low_ = {};
  std::array<double, most> rest_ = {};
};

/// A sum of any number of doubles, exact, for the few that RoundedSums cannot round. Terms are finite and below 2^900.
class ExactSum
{
public:
  void add(double term) noexcept { sum_.add(term); }

  /// Returns the sum, correctly rounded.
  double value() const noexcept
  {
    const std::span<const double> parts = sum_.parts();
    if (parts.empty())
    {
      return 0;
    }
    std::size_t i = parts.size() - 1;
    double high = parts[i];
    double low = 0;
    while (i > 0 && low == 0)
    {
      const double before = high;
      high = before + parts[--i];
      low = parts[i] - (high - before);
    }
    // halfway between two doubles: what is left decides
    if (i > 0 && (low > 0) == (parts[i - 1] > 0))
    {
      const double twice = 2 * low;
      const double other = high + twice;
      high = other - high == twice ? other : high;
    }
    return high;
  }

private:
  /// Doubles that do not overlap, of all the bits that there are between 2^-1074 and 2^960.
  Expansion<2048> sum_;
};
}
#endif
