// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_minimum_image_h
#define granular_local_minimum_image_h

#include "granular/base/box.h"

#include <array>
#include <cstdint>

namespace granular
{
/// How many of each box vector.
using BoxCounts = std::array<std::int64_t, 3>;

/// Finds the shortest of the periodic images of a vector, in any box, however tilted.
class MinimumImage
{
public:
  /// Axes are periodic where the boundary flags of the box say so and its vector has a length.
  explicit MinimumImage(const Box& box);

  /// Whether any axis is.
  bool is_periodic() const noexcept;

  /// The box vectors to be added to a vector to get the shortest of its images; 0 along axes that are not periodic,
  /// and for a vector that is not finite. Of images of the same length, within rounding, that with the smallest counts.
  BoxCounts find(const Vector3& vector) const noexcept;

  /// That many box vectors, rounded once.
  Vector3 shift(const BoxCounts& counts) const noexcept;
};
}
#endif
