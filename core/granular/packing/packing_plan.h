// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_packing_plan_h
#define granular_packing_packing_plan_h

#include "granular/common/progress.h"
#include "granular/packing/box_shape.h"
#include "granular/packing/chain.h"
#include "granular/packing/lattice.h"
#include "granular/packing/packing.h"
#include "granular/packing/radii.h"
#include "granular/packing/random_packing.h"

#include <cmath>
#include <cstdint>
#include <optional>

namespace granular
{
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
