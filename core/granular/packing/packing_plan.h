// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_packing_plan_h
#define granular_packing_packing_plan_h

#include "granular/common/progress.h"
#include "granular/packing/box_shape.h"
#include "granular/packing/lattice.h"
#include "granular/packing/packing.h"
#include "granular/packing/radii.h"
#include "granular/packing/random_packing.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

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

/// The plan of a request: its box, and the number, sizes and positions of particles. It is the same on all ranks whose
/// requests are the same except for pieces and threads.
class PackingPlan
{
public:
  /// Throws LimitError for impossible requests; Cancelled.
  PackingPlan(const PackingRequest& request, Progress& progress);

  PackingPlan(const PackingPlan&) = delete;
  PackingPlan& operator=(const PackingPlan&) = delete;

  PackingRequest request;
  Box box;
  BoxShape shape;
  std::int64_t grains = 0;
  std::int64_t first = 0; ///< row of the piece
  std::int64_t last = 0;  ///< the row after the piece

  PlacedParticle particle(std::int64_t row) const noexcept;

  /// Calls visit for every particle that is nearer to another one than a distance, and for some that are not: rows of a
  /// lattice may be beyond its particles. Not for chains.
  void visit_near(std::int64_t row, double distance, const VisitNear& visit) const;

private:
  Radii radii_;
  double nearest_ =
    HUGE_VAL; ///< no two particles of a lattice or chain are nearer: larger radii are cut to half of it
  std::optional<Lattice> lattice_;
  std::optional<Chain> chain_;
  std::optional<RandomPacking> random_;
};
}
#endif
