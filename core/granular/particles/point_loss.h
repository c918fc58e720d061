// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_point_loss_h
#define granular_particles_point_loss_h

#include "granular/common/error.h"
#include "granular/frames/frame.h"
#include "granular/particles/rounding_loss.h"

#include <cstdint>

namespace granular
{
/// Returns the loss of rows in the box if an origin is subtracted from absolute coordinates, in doubles.
void add_rounding(
  std::int64_t rows, const Box& box, const Vector3& origin, RoundingLoss& loss) noexcept;

/// Adds a notice about the loss of a frame's points if it exceeds a RoundingLimit: once per file and origin. origin:
/// subtracted from the points; single: they are floats.
void note_point_loss(const RoundingLoss& loss, const Box& box, const Vector3& origin, bool single,
  const Where& where, Notices& notices);

/// Adds a notice about points that the box of a header scales, if the digits of its bounds move them by more than a
/// RoundingLimit: once per file. radius: the smallest one, or HUGE_VAL.
void note_box_loss(const FrameHeader& header, double radius, const Where& where, Notices& notices);
}
#endif
