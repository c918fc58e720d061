// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_fragments_h
#define granular_paths_fragments_h

#include "granular/parallel/communicator.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace granular
{
/// The fragment of each particle of a rank.
struct Fragments
{
  std::vector<std::int64_t> labels; ///< smallest id of the particles in the fragment
  std::vector<std::int64_t> sizes;  ///< number of particles in it, at least 1
  std::vector<double> masses; ///< of all particles in it, correctly rounded; empty without masses
  std::int64_t missing = 0;   ///< lines of all ranks that name a particle that no rank has
};

/// Finds the fragments of particles: those that lines connect, directly or through others, and particles without lines
/// alone. ids: of the particles of this rank, without duplicates of other ranks' particles. masses: one per particle on all
/// ranks, or none on any. id1[i] and id2[i] are the ends of line i of this rank; a line counts only if ranks have both
/// particles. Particles and lines may be on any ranks and in any order, which changes no bit.
///
/// The mass of a fragment is nan if one of its masses is not finite or not below 2^900.
///
/// The first rank needs memory for all particles with lines, and all ranks for their fragments.
///
/// Throws Error on all ranks if an id repeats: see IdDirectory::expect_distinct; std::bad_alloc. Collective.
Fragments find_fragments(std::span<const std::int64_t> ids,
  std::optional<std::span<const double>> masses, std::span<const std::int64_t> id1,
  std::span<const std::int64_t> id2, Communicator& ranks);
}
#endif
