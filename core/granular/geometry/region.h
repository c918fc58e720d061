// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_geometry_region_h
#define granular_geometry_region_h

#include <cstddef>
#include <span>

namespace granular
{
/// A region: xlo xhi ylo yhi zlo zhi, closed; an axis with lo > hi is not restricted.
using Region = std::span<const double, 6>;

/// Returns true if the region restricts an axis.
inline bool restricts(Region region) noexcept
{
  return region[0] <= region[1] || region[2] <= region[3] || region[4] <= region[5];
}

/// Returns true if a point is inside. A coordinate that is no number is in no region that restricts its axis.
inline bool contains(Region region, const double* point) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double lo = region[2 * axis];
    const double hi = region[2 * axis + 1];
    if (lo <= hi && !(point[axis] >= lo && point[axis] <= hi))
    {
      return false;
    }
  }
  return true;
}
}
#endif
