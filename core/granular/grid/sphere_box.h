// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_grid_sphere_box_h
#define granular_grid_sphere_box_h

#include "granular/geometry/box.h"

namespace granular
{
/// Returns the volume of a sphere [m3].
double sphere_volume(double radius) noexcept;

/// Returns the common volume of a sphere and a box along the axes, for any finite numbers with lo <= hi and radius >= 0, from
/// 0 to the smaller of the two volumes. lo and hi are relative to the centre; edges are the lengths of the box, which may be
/// more exact than hi - lo. The error is at most 1e-12 min(V_sphere, V_box) + 16 * 2^-53 * radius * A_max, with A_max the
/// largest face of the box; lo and hi may be rounded differences.
double centred_box_volume(
  double radius, const Vector3& lo, const Vector3& hi, const Vector3& edges) noexcept;

/// Returns the product of three lengths, in an order without over- or underflow on the way.
double box_volume(const Vector3& edges) noexcept;
}
#endif
