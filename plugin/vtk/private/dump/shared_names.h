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
