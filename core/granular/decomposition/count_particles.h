// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_count_particles_h
#define granular_decomposition_count_particles_h

#include "granular/common/progress.h"
#include "granular/decomposition/process_grid.h"
#include "granular/decomposition/subdomains.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// How many particles are where.
struct ParticleCounts
{
  std::vector<std::int64_t> particles; ///< of each subdomain
  std::int64_t outside = 0;            ///< of all; also those without a place (nan, inf)

  bool operator==(const ParticleCounts&) const = default;
};

/// Counts the particles of a frame in the subdomains of a grid: each in one, lo <= x < hi along each axis, and x <= hi
/// in the last; where cuts coincide, in the last that begins there. Comparisons of doubles decide, no computed index.
/// Positions are absolute, wrapped into the frame's box along periodic axes: images of particles outside compare with cuts as
/// exact ones do (see AbsolutePositions). Duplicates are left out. Time grows with the particles, not with the subdomains. Does not depend on threads, each of which has
/// counts of its own, as far as they fit into 1 GiB together. Throws Error: rows without points, cuts that decrease
/// or are not finite; Cancelled.
ParticleCounts count_in_grid(
  const FrameView& frame, const ProcessGrid& grid, const Executor& executor, Progress& progress);

/// The same for any subdomains that do not overlap: x <= hi holds at the upper faces of the smallest box around all,
/// and where no neighbour begins there. Of several that are flat, or end, where a particle is, the one that begins last
/// along x, then y, then z, has it; of equal ones the last. Where subdomains overlap, one of them has it. A grid in
/// whatever order is counted as one; of n others a tree is made, in n log n.
ParticleCounts count_in_subdomains(const FrameView& frame, std::span<const Subdomain> subdomains,
  const Executor& executor, Progress& progress);

/// What there is of particles, by rank of the process: their bounds, and how many they are.
struct ParticleBounds
{
  std::vector<Subdomain> subdomains;
  std::int64_t outside = 0; ///< particles without a place (nan, infinite): they are in none
};

/// For each process that the array names for a particle of this rank: the bounds of its particles, and how many
/// they are, by rank. process has one whole number from 0 to 2^31 - 1 a row; others throw an Error that names the
/// array. Positions as above, not wrapped; particles without a place are left out. Throws Error, Cancelled.
ParticleBounds bounds_by_process(
  const FrameView& frame, const ArrayView& process, const Executor& executor, Progress& progress);

/// The bounds of all particles of this rank, and how many; nothing without any. rank is 0.
ParticleBounds bounds_of_particles(
  const FrameView& frame, const Executor& executor, Progress& progress);

/// Joins what the ranks have: one subdomain for each process that any of them knows, by rank, on all. Collective.
std::vector<Subdomain> join_by_process(std::span<const Subdomain> own, Communicator& ranks);
}
#endif
