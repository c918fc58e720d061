// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_grain_bounds_h
#define granular_dump_write_grain_bounds_h

#include "granular/geometry/box.h"
#include "granular/particles/frame_view.h"

#include <cmath>

namespace granular
{
/// The extent of particles along the axes.
struct GrainBounds
{
  Vector3 lo = { HUGE_VAL, HUGE_VAL, HUGE_VAL };
  Vector3 hi = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };

  void add(const GrainBounds& other) noexcept;

  /// Returns the box around the particles, with boundaries that nothing crosses; at 0 without particles.
  Box box() const;
};

/// Returns the bounds of the spheres, or of the points without radii; duplicates and non-finite points are ignored. The
/// points of the frame are absolute. Throws Error for rows without points.
GrainBounds bounds_of_grains(const FrameView& frame);
}
#endif
