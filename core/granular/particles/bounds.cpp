// SPDX-License-Identifier: BSD-3-Clause
#include "granular/particles/bounds.h"

#include "granular/common/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace granular
{
std::pair<Vector3, Vector3> find_bounds(
  const FrameView& particles, const std::array<double, 6>& given, const char* tilted)
{
  if (std::ranges::any_of(given, [](double bound) { return std::isnan(bound); }))
  {
    throw Error("expected Bounds of numbers, got nan");
  }
  const bool all = is_given(&given[0]) && is_given(&given[2]) && is_given(&given[4]);
  if (!all && !particles.has_box)
  {
    throw Error("expected the box in the field data of the input (BoxOrigin, BoxVectors), "
                "got none: give Bounds");
  }
  const Box& own = particles.header.box;
  const bool fits = !own.tilted || (tilted == nullptr && !own.general);
  if (!all && !fits)
  {
    throw UnsupportedError("expected a box along the axes, got a tilted one: " +
      std::string(tilted != nullptr ? tilted : "give Bounds"));
  }
  const BoxBounds box = all ? BoxBounds{} : own.bounds();
  Vector3 lo = box.lo;
  Vector3 hi = box.hi;
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (is_given(&given[2 * k]))
    {
      lo[k] = given[2 * k];
      hi[k] = given[2 * k + 1];
    }
  }
  return { lo, hi };
}
}
