// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_bounds_h
#define granular_particles_bounds_h

#include "granular/particles/frame_view.h"

#include <array>
#include <utility>

namespace granular
{
/// Returns the lower and the upper corner of a box for particles: along each axis the given bounds, xlo xhi ylo yhi zlo zhi, or those of
/// the box of the particles where lo is above hi. Throws Error if it is needed and there is none, or for nan; UnsupportedError for a
/// tilted box, with the text `tilted`, or, if tilted is null, for a box without axis-aligned bounds.
std::pair<Vector3, Vector3> find_bounds(
  const FrameView& particles, const std::array<double, 6>& given, const char* tilted);
}
#endif
