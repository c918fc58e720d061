// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_placed_particle_h
#define granular_packing_placed_particle_h

#include "granular/packing/box_shape.h"

#include <array>
#include <cstdint>
#include <functional>

namespace granular
{
/// A particle of a packing; its id is its row + 1.
struct PlacedParticle
{
  Vector3 point;
  double radius;
  std::int32_t type;
};

/// Number of each box vector that a periodic image is away.
using PeriodicImage = std::array<std::int8_t, 3>;

/// Returns the image in which a cell is that lies beyond the cells from 0 to count - 1.
constexpr std::int64_t image_of(std::int64_t cell, std::int64_t count) noexcept
{
  return cell < 0 ? (cell + 1) / count - 1 : cell < count ? 0 : cell / count;
}

/// Returns a position moved by the box vectors of an image, or back by them with the sign -1.
inline Vector3 moved(
  const Vector3& at, const PeriodicImage& image, const BoxShape& box, double sign = 1) noexcept
{
  if (image == PeriodicImage{})
  {
    return at;
  }
  const Vector3 edge = box.edge({ sign * image[0], sign * image[1], sign * image[2] });
  return { at[0] + edge[0], at[1] + edge[1], at[2] + edge[2] };
}

/// Receives particles near another one, once per image.
using VisitNear = std::function<void(std::int64_t row, const PeriodicImage& image)>;
}
#endif
