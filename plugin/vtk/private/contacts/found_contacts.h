// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularFoundContacts_h
#define vtkGranularFoundContacts_h

#include "private/contacts/contact_input.h"

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/contacts/find_ends.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/frame_view.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

class vtkDataObject;

namespace vtkGranularPrivate
{
/**
 * The contacts of two inputs, between particles and with walls, either of which may be null, with the particles at their ends.
 */
class FoundContacts
{
public:
  /**
   * grains: the input of the particles, a notice tells if it is of another timestep. forces: false reads none, where no stress
   * is wanted; otherwise a notice tells if there are none. Throws what ContactInput and FoundEnds throw. Collective.
   */
  FoundContacts(const std::array<vtkDataObject*, 2>& inputs, vtkDataObject& grains,
    const granular::FrameView& particles, bool forces, granular::Communicator& ranks,
    const granular::Executor& executor, granular::Notices& notices, granular::Progress& progress);
  FoundContacts(const FoundContacts&) = delete;
  void operator=(const FoundContacts&) = delete;

  const granular::FoundEnds& GetEnds() const { return *this->Ends; }

  /**
   * Returns the numbers of contacts of all ranks that name a particle which is not there: lines, and rows that nothing places,
   * which are left out; then of those left out because a number is not finite.
   */
  const std::array<std::int64_t, 3>& CountLeftOut() const { return this->LeftOut; }

private:
  std::array<std::optional<ContactInput>, 2> Contacts;
  std::vector<granular::ContactRows> Rows;
  std::optional<granular::FoundEnds> Ends;
  std::array<std::int64_t, 3> LeftOut = {};
};
}

#endif
