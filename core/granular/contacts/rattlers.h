// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_contacts_rattlers_h
#define granular_contacts_rattlers_h

#include "granular/common/progress.h"
#include "granular/local/id_finder.h"
#include "granular/parallel/communicator.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// A contact that counts, between two particles of a list, or one and a wall or a particle that is not there (-1).
using ContactPair = std::array<std::int64_t, 2>;

/// The particles that do not bear, and the contacts of those that do.
struct Rattlers
{
  std::vector<unsigned char> are; ///< 1 for a rattler, of each particle of this rank
  std::vector<std::int32_t>
    contacts; ///< of each with particles that are no rattlers and with walls; 0 for rattlers
};

/// Finds the particles of this rank with fewer contacts than `least`, and those that have fewer without the contacts of those
/// found before, until all that are left have as many. homes: of a list of particles, which pairs name; those without a home
/// are in no pair. coordination: of the particles of this rank. Collective.
Rattlers find_rattlers(std::span<const ParticleHome> homes, std::span<const ContactPair> pairs,
  std::span<const std::int32_t> coordination, std::int32_t least, Communicator& ranks,
  Progress& progress);
}
#endif
