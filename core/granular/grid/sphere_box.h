// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_grid_sphere_box_h
#define granular_grid_sphere_box_h

#include "granular/geometry/box.h"

#include <array>

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

/// Returns the common volume of a sphere around the origin and a box, 0 <= lo <= hi, by quadrature of the areas of its
/// slices: a sum of positive terms, so nothing cancels, however small the box is against the sphere. The cube of the radius
/// must neither over- nor underflow.
double octant_volume(double radius, Vector3 lo, Vector3 hi) noexcept;

/// The volumes of the up to eight parts into which planes across x, y and z cut a sphere. Bit 0 of the index is set on the
/// side of the plane across x without the centre, bits 1 and 2 likewise for y and z.
using SphereParts = std::array<double, 8>;

/// distances: of the planes from the centre, from 0; the radius and more: no plane. In closed form; the error of a part is a
/// few ulps of the sphere's volume.
SphereParts cut_sphere(double radius, const Vector3& distances) noexcept;
}
#endif
