// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_chain_h
#define granular_packing_chain_h

#include "granular/packing/box_shape.h"

#include <array>
#include <cstdint>

namespace granular
{
/// A straight row of particles along the first box vector, in the middle of the box, which begins one radius inside the low
/// face. Where rounding could bring neighbours nearer than the distance, they are farther apart by as much, if the box has
/// room.
class Chain
{
public:
  /// distance: of neighbours. particles: 0 for as many as the box holds. Throws LimitError if they do not fit.
  Chain(const BoxShape& box, double distance, double radius, std::int64_t particles);

  std::int64_t particles() const noexcept { return particles_; }

  /// Returns the position of a particle in the box of the constructor.
  Vector3 point(std::int64_t row, const BoxShape& box) const noexcept;

  /// Returns a distance that no two particles and images are nearer than, in exact arithmetic.
  double nearest() const noexcept { return nearest_; }

  /// Returns the lengths of a box. Across periodic axes images are as far away as particles are from each other.
  static Vector3 lengths_for(
    const std::array<bool, 3>& periodic, double distance, double radius, std::int64_t particles);

private:
  std::int64_t particles_;
  double first_; ///< scaled coordinate along the chain
  double step_;
  double nearest_;
  double exact_first_ = 0; ///< coordinate along the chain, if all coordinates are doubles
  double exact_step_ = 0;  ///< 0: they are not
};
}
#endif
