// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_packing_plan_h
#define granular_packing_packing_plan_h

#include "granular/common/progress.h"
#include "granular/packing/box_shape.h"
#include "granular/packing/fibres.h"
#include "granular/packing/lattice.h"
#include "granular/packing/packing.h"
#include "granular/packing/radii.h"
#include "granular/packing/random_grains.h"
#include "granular/parallel/communicator.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace granular
{
/// The plan of a request: its box, and the number, sizes and positions of particles. The requests of all ranks are the same
/// except for pieces and threads.
class PackingPlan
{
public:
  /// Collective for random particles only: each rank places those of its part of the box, and the ranks count. Throws on all
  /// ranks LimitError for impossible requests; Cancelled.
  PackingPlan(const PackingRequest& request, Communicator& ranks, Progress& progress);

  PackingPlan(const PackingPlan&) = delete;
  PackingPlan& operator=(const PackingPlan&) = delete;

  PackingRequest request;
  Box box;
  BoxShape shape;
  std::optional<Fibres> fibres; ///< of a chain or a bundle
  std::int64_t grains = 0;
  Radii radii;
  double nearest =
    HUGE_VAL; ///< no two particles of a lattice or of fibres are nearer: larger radii are cut to half of it

  /// Returns the rows of the piece.
  RowRange rows() const noexcept;

  /// Returns any rows of the particles: each position is a function of the request and of its row. Throws Cancelled.
  void place_rows(const GrainRows& rows, Progress& progress) const;

  /// Returns ranges of later rows that contain every particle within a distance, at most six of the largest radii, of a
  /// particle in `rows`. Not for fibres. rows are not empty.
  std::vector<RowRange> rows_near(const RowRange& rows, double distance) const;

private:
  std::optional<Lattice> lattice_;
  std::optional<RandomGrains> random_;
};
}
#endif
