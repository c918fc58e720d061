// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_subdomains_count_particles_h
#define granular_subdomains_count_particles_h

#include "granular/common/progress.h"
#include "granular/grid/process_grid.h"
#include "granular/grid/subdomains.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// The number of particles in each subdomain.
struct ParticleCounts
{
  std::vector<std::int64_t> particles; ///< of each subdomain
  std::int64_t outside = 0; ///< outside all; also particles without a position (nan, inf)

  bool operator==(const ParticleCounts&) const = default;
};

/// Counts the particles of a frame in the subdomains of a grid: each in one, lo <= x < hi along each axis, and x <= hi in the
/// last; where cuts coincide, in the last that begins there. Comparisons of doubles decide, not a computed index. Positions
/// are absolute, wrapped into the frame's box along periodic axes; images of particles outside compare with cuts like the
/// exact ones (see AbsolutePositions). Duplicates are left out. The time grows with the particles, not with the subdomains.
/// The result does not depend on threads; each has counts of its own, if they fit into 1 GiB together. Throws Error for rows
/// without points, and cuts that decrease or are not finite; Cancelled.
ParticleCounts count_in_grid(
  const FrameView& frame, const ProcessGrid& grid, const Executor& executor, Progress& progress);

/// Counts particles in any subdomains that do not overlap: x <= hi holds at the upper faces of the smallest box around all,
/// and where no neighbour begins. Where several flat or adjacent subdomains share a position, the one that begins last along
/// x, then y, then z, has the particle; of equal ones the last. If subdomains overlap, one of them has it. A grid in any
/// order is counted as one; n other subdomains form a tree, in n log n.
ParticleCounts count_in_subdomains(const FrameView& frame, std::span<const Subdomain> subdomains,
  const Executor& executor, Progress& progress);

/// The bounds and numbers of particles, by rank.
struct ParticleBounds
{
  std::vector<Subdomain> subdomains;
  std::int64_t outside = 0; ///< particles without a position (nan, infinite): they are in none
};

/// Returns the bounds and number of this rank's particles for each owner in the array, by owner. `process` has one integer
/// from 0 to 2^31 - 1 per row; others throw an Error that names the array. Positions as above, not wrapped; particles without
/// a position are left out. Throws Error, Cancelled.
ParticleBounds bounds_by_process(
  const FrameView& frame, const ArrayView& process, const Executor& executor, Progress& progress);

/// Returns the bounds and number of all particles of this rank; nothing without any. rank is 0.
ParticleBounds bounds_of_particles(
  const FrameView& frame, const Executor& executor, Progress& progress);

/// Joins the results of all ranks: one subdomain per owner that any rank knows, by owner, on all ranks. Collective.
std::vector<Subdomain> join_by_process(std::span<const Subdomain> own, Communicator& ranks);
}
#endif
