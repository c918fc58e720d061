// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_tests_euler_sphere_box_volume_h
#define granular_tests_euler_sphere_box_volume_h

#include "granular/grid/sphere_box.h"

#include <cstddef>

/// centred_box_volume of a sphere and a box anywhere.
inline double sphere_box_volume(const granular::Vector3& centre, double radius,
  const granular::Vector3& lo, const granular::Vector3& hi)
{
  granular::Vector3 from = {};
  granular::Vector3 to = {};
  granular::Vector3 edges = {};
  for (std::size_t k = 0; k < 3; ++k)
  {
    from[k] = lo[k] - centre[k];
    to[k] = hi[k] - centre[k];
    edges[k] = hi[k] - lo[k];
  }
  return granular::centred_box_volume(radius, from, to, edges);
}
#endif
