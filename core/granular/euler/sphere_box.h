// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_euler_sphere_box_h
#define granular_euler_sphere_box_h

#include "granular/geometry/box.h"

namespace granular
{
/// The volume of a sphere [m3].
double sphere_volume(double radius) noexcept;

/// The volume that a sphere and a box along the axes have in common, for any finite numbers with lo <= hi and
/// radius >= 0, from 0 to the volume of the smaller of the two. lo and hi are seen from the centre, and edges are the lengths of
/// the box, which may be known better than by hi - lo.
/// The error is at most 1e-12 min(V_sphere, V_box) + 16 * 2^-53 * radius * A_max, A_max the largest face of the box; the
/// differences that lo and hi are may be rounded.
double centred_box_volume(
  double radius, const Vector3& lo, const Vector3& hi, const Vector3& edges) noexcept;

/// The product of three lengths, in the order in which it does not over- or underflow on its way.
double box_volume(const Vector3& edges) noexcept;
}
#endif
