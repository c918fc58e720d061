// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_grid_sphere_octant_h
#define granular_grid_sphere_octant_h

#include "granular/geometry/box.h"

namespace granular
{
/// Returns the common volume of a sphere around the origin and a box, 0 <= lo <= hi, by quadrature of the areas of its
/// slices: a sum of positive terms, so nothing cancels, however small the box is against the sphere. The cube of the radius
/// must neither over- nor underflow.
double octant_volume(double radius, Vector3 lo, Vector3 hi) noexcept;
}
#endif
