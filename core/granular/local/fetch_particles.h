// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_fetch_particles_h
#define granular_local_fetch_particles_h

#include "granular/local/id_directory.h"
#include "granular/local/particle_values.h"
#include "granular/parallel/communicator.h"

#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// The particles that a rank owns.
struct OwnParticles
{
  std::span<const std::int64_t> ids; ///< one a row
  const unsigned char* ghosts;       ///< a value a row, or null; see FrameView::duplicate_row
  const ParticleValues& values;      ///< the same arrays on all ranks
};

/// Particles that one rank has requested from all ranks.
struct FetchedParticles
{
  std::vector<std::int64_t> ids; ///< each once
  ParticleValues values;         ///< as doubles
  std::int64_t repeated =
    0; ///< particles that this rank has seen whose id an earlier one has; see below
};

/// Fetches the particles with the wanted ids, each once in the list, from whichever rank owns them; ids that no rank owns are
/// left out. The directory is that of the particles of all ranks, in the rows of their values. Collective.
FetchedParticles fetch_particles(const ParticleValues& own, const IdDirectory& directory,
  const std::vector<std::int64_t>& wanted, Communicator& ranks);

/// Fetches the particles that the two ends of this rank's lines name. Of particles with the same id, the first of the lowest
/// rank counts. Collective.
FetchedParticles fetch_particles(const OwnParticles& own, std::span<const std::int64_t> id1,
  std::span<const std::int64_t> id2, Communicator& ranks);
}
#endif
