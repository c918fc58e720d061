// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularSharedNames_h
#define vtkGranularSharedNames_h

#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include <string>
#include <vector>

namespace vtkGranularPrivate
{
/**
 * The arrays of numbers of particles that a rank knows, but for ids.
 */
struct KnownArrays
{
  bool HasParticles = false;
  std::vector<std::string> Names; ///< which may have blanks
  std::vector<int> Sizes;         ///< their components
};

/**
 * Returns what the first rank with particles knows; if none has particles, what the last rank knows. Collective.
 */
KnownArrays ShareArrays(const granular::FrameView& particles, granular::Communicator& ranks);

/**
 * Returns the names in a list, separated by blanks or commas; "*" stands for all of some names.
 */
std::vector<std::string> NamesIn(std::string list, const std::vector<std::string>& all);

/**
 * Returns the names in a list, separated by blanks or commas, the same on all ranks; "*" stands for all arrays of numbers but
 * id of the first rank that has particles. Collective.
 */
std::vector<std::string> ShareNames(
  const std::string& list, const granular::FrameView& particles, granular::Communicator& ranks);
}

#endif
