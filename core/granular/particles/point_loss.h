// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_point_loss_h
#define granular_particles_point_loss_h

#include "granular/common/error.h"
#include "granular/particles/rounding_loss.h"

#include <cstdint>

namespace granular
{
/// What rows in the box lose where an origin is subtracted from absolute coordinates, in doubles.
void add_rounding(
  std::int64_t rows, const Box& box, const Vector3& origin, RoundingLoss& loss) noexcept;

/// Says how much points of a frame have lost, if that is more than a RoundingLimit: once a file and
/// origin. origin is what was subtracted from them; single: they are floats.
void note_point_loss(const RoundingLoss& loss, const Box& box, const Vector3& origin, bool single,
  const Where& where, Notices& notices);
}
#endif
