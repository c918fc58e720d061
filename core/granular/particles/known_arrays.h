// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_known_arrays_h
#define granular_particles_known_arrays_h

#include "granular/particles/frame_view.h"

#include <string>
#include <vector>

namespace granular
{
class Communicator;

/// The arrays of numbers of particles that a rank knows, but for ids.
struct KnownArrays
{
  bool has_particles = false;
  std::vector<std::string> names; ///< which may have blanks
  std::vector<int> sizes;         ///< their components
};

/// Returns what the first rank with particles knows; if none has particles, what the last rank knows. Collective.
KnownArrays share_arrays(const FrameView& particles, Communicator& ranks);

/// Returns the names in a list, separated by blanks or commas; "*" stands for all of some names.
std::vector<std::string> names_in(std::string list, const std::vector<std::string>& all);

/// Returns the names in a list, separated by blanks or commas, the same on all ranks; "*" stands for all arrays of numbers but id of
/// the first rank that has particles. Collective.
std::vector<std::string> share_names(
  const std::string& list, const FrameView& particles, Communicator& ranks);
}
#endif
