// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_fetch_particles_h
#define granular_local_fetch_particles_h

#include "granular/local/particle_values.h"
#include "granular/parallel/communicator.h"

#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// What a rank has of the particles.
struct OwnParticles
{
  std::span<const std::int64_t> ids; ///< one a row
  const unsigned char* ghosts;       ///< a value a row, or null; see FrameView::duplicate_row
  const ParticleValues& values;      ///< the same arrays on all ranks
};

/// Particles of all ranks that one rank has asked for.
struct FetchedParticles
{
  std::vector<std::int64_t> ids; ///< each once
  ParticleValues values;         ///< as doubles
  std::int64_t repeated =
    0; ///< particles that this rank has seen whose id an earlier one has; see below
};

/// Finds the particles that the two ends of this rank's lines name, wherever they are; those that nobody has are left
/// out. Of particles with the same id the first of the lowest rank is taken. Each id belongs to one rank, by
/// its hash, which is told who has it and answers those who ask; it counts the repeated ones. No
/// rank needs memory for more than its own particles, its share of the ids, and what it asks for. Collective.
FetchedParticles fetch_particles(const OwnParticles& own, std::span<const std::int64_t> id1,
  std::span<const std::int64_t> id2, Communicator& ranks);
}
#endif
