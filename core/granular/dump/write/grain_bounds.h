// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_grain_bounds_h
#define granular_dump_write_grain_bounds_h

#include "granular/geometry/box.h"
#include "granular/particles/frame_view.h"

#include <cmath>

namespace granular
{
/// How far grains reach along the axes.
struct GrainBounds
{
  Vector3 lo = { HUGE_VAL, HUGE_VAL, HUGE_VAL };
  Vector3 hi = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };

  void add(const GrainBounds& other) noexcept;

  /// The box around them, with boundaries that nothing crosses; at 0 where there are none.
  Box box() const;
};

/// The bounds of the spheres where there are radii, else of the points; of duplicates and of what is not finite
/// none. The points of the frame are absolute. Throws Error where there are rows without points.
GrainBounds bounds_of_grains(const FrameView& frame);
}
#endif
