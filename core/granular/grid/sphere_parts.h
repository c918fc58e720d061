// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_grid_sphere_parts_h
#define granular_grid_sphere_parts_h

#include "granular/geometry/box.h"

#include <array>
#include <cstddef>

namespace granular
{
/// The volumes of the up to eight parts into which planes across x, y and z cut a sphere. Bit 0 of the index is set on the
/// side of the plane across x without the centre, bits 1 and 2 likewise for y and z.
using SphereParts = std::array<double, 8>;

/// distances: of the planes from the centre, from 0; the radius and more: no plane. In closed form; the error of a part is a
/// few ulps of the sphere's volume.
SphereParts cut_sphere(double radius, const Vector3& distances) noexcept;
}
#endif
