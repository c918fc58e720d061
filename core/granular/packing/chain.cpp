// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/chain.h"

#include "granular/common/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace granular
{
namespace
{
/// Returns how many particles the box holds: whole distances between them, and a radius at both ends.
std::int64_t room_for(const BoxShape& box, double length, double distance, double radius)
{
  constexpr double tolerance = 1e-12; // a box that was made for a chain may have been rounded
  constexpr double most = 1e12;
  const double inside = length * (1 - 2 * radius / box.heights[0]) / distance;
  const double steps = std::floor(inside + tolerance * (1 + length / distance));
  return static_cast<std::int64_t>(std::clamp(steps, 0.0, most)) + 1;
}
}

Chain::Chain(const BoxShape& box, double distance, double radius, std::int64_t particles)
  : first_(radius / box.heights[0])
  , nearest_(distance)
{
  const double length = length_of(box.vectors[0]);
  const std::int64_t room = room_for(box, length, distance, radius);
  if (particles > room)
  {
    throw LimitError("expected at most " + std::to_string(room) +
      " grains, which the box holds along its first vector, got " + std::to_string(particles));
  }
  particles_ = particles > 0 ? particles : room;
  step_ = distance / length;
  const double rounding = 2 * box.rounding();
  const auto steps = static_cast<double>(particles_ - 1);
  const double rest = length - steps * distance; // at both ends
  if (box.adds({ box.origin[0], length, distance, radius }) && rest >= 2 * radius)
  {
    exact_first_ = box.origin[0] + radius;
    exact_step_ = distance;
  }
  else if (rest - steps * rounding >= length * 2 * radius / box.heights[0] + rounding)
  {
    step_ = (distance + rounding) / length;
  }
  else
  {
    nearest_ = std::min(distance, rest) - rounding;
  }
  for (std::size_t axis = 1; axis < 3; ++axis)
  {
    if (box.periodic[axis])
    {
      nearest_ = std::min(nearest_, box.heights[axis] - (box.aligned ? 0 : rounding));
    }
  }
}

Vector3 Chain::point(std::int64_t row, const BoxShape& box) const noexcept
{
  const auto steps = static_cast<double>(row);
  Vector3 point = box.point({ first_ + steps * step_, 0.5, 0.5 });
  if (exact_step_ > 0)
  {
    point[0] = exact_first_ + steps * exact_step_;
  }
  return point;
}

Vector3 Chain::lengths_for(
  const std::array<bool, 3>& periodic, double distance, double radius, std::int64_t particles)
{
  Vector3 lengths;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lengths[axis] = periodic[axis] ? distance : 2 * radius;
  }
  lengths[0] += static_cast<double>(particles - 1) * distance;
  return lengths;
}
}
