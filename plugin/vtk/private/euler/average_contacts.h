// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularAverageContacts_h
#define vtkGranularAverageContacts_h

#include "granular/common/progress.h"
#include "granular/euler/average.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/frame_view.h"

#include <array>
#include <cstdint>

class vtkDataObject;

namespace vtkGranularPrivate
{
/**
 * Contacts of all ranks that count in part or not at all.
 */
struct ContactsLeft
{
  std::int64_t Missing = 0; ///< a particle is not there
  std::int64_t Broken = 0;  ///< a number is not finite
};

/**
 * Adds the contacts between particles and those with walls, either of which may be null, to averages of the particles. forces:
 * false reads none, where no stress is wanted. Throws what ContactInput, FoundEnds and average_contacts throw. Collective.
 */
ContactsLeft AverageContacts(const std::array<vtkDataObject*, 2>& inputs,
  const granular::FrameView& particles, const granular::EulerAverageRequest& request, bool forces,
  granular::Communicator& ranks, const granular::Executor& executor, granular::Progress& progress,
  granular::EulerAverages& averages);
}

#endif
