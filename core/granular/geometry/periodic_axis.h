// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_geometry_periodic_axis_h
#define granular_geometry_periodic_axis_h

#include "granular/geometry/expansion.h"

#include <algorithm>
#include <cmath>

namespace granular
{
/// A coordinate as an exact sum, with room for a number of periods.
using ExactCoordinate = Expansion<16>;

/// An axis of an orthogonal box: x and x + length are the same position.
struct PeriodicAxis
{
  double lo = 0;
  double hi = 0;
  Twofold length; ///< hi - lo; finite, above 0

  bool holds(double x) const noexcept { return x >= lo && x < hi; }

  /// Returns the largest double not above the exact image in [lo, hi) of a coordinate: comparisons with doubles give the same
  /// result for both. nearby: the coordinate within some ulps. A coordinate 2^52 lengths away, where no bit gives the
  /// position, stays nearby.
  double wrap(const ExactCoordinate& x, double nearby) const noexcept
  {
    if (!(std::abs(nearby - lo) < 0x1p52 * length.value()))
    {
      return nearby;
    }
    double count = std::floor((nearby - lo) / length.value());
    double image = this->image(x, count);
    // the quotient was rounded: by some at most
    for (int turn = 0; turn < 8 && !this->holds(image); ++turn)
    {
      count += image < lo ? -1 : 1;
      image = this->image(x, count);
    }
    return std::clamp(image, lo, std::nextafter(hi, lo)); // hi - length is lo within rounding
  }

private:
  double image(ExactCoordinate x, double count) const noexcept
  {
    x.add_product(-count, length);
    return x.floor();
  }
};
}
#endif
