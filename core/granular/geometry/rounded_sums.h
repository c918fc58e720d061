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
