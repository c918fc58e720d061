// SPDX-License-Identifier: BSD-3-Clause
#include "private/contacts/found_contacts.h"

#include "vtkDataObject.h"
#include "vtkPointSet.h"

#include <cstddef>
#include <string>

namespace vtkGranularPrivate
{
FoundContacts::FoundContacts(const std::array<vtkDataObject*, 2>& inputs, vtkDataObject& grains,
  const granular::FrameView& particles, bool forces, granular::Communicator& ranks,
  const granular::Executor& executor, granular::Notices& notices, granular::Progress& progress)
{
  constexpr Touched touched[] = { Touched::Particles, Touched::Walls };
  for (std::size_t port = 0; port < inputs.size(); ++port)
  {
    if (inputs[port])
    {
      ContactArrays wanted;
      wanted.Force = forces;
      wanted.Point = port == 1 && !vtkPointSet::SafeDownCast(inputs[port]); // where the wall is
      this->Contacts[port].emplace(inputs[port], touched[port], wanted, progress);
      this->Rows.push_back(this->Contacts[port]->GetRows());
      const std::string text =
        CompareTimesteps(grains.GetFieldData(), inputs[port]->GetFieldData());
      if (!text.empty())
      {
        notices.push_back({ {}, text });
      }
    }
  }
  granular::ContactOptions options;
  options.arm = granular::LeverArm::Half; // nobody asks where forces act: radii are not needed
  granular::PartialProgress parts(progress);
  this->Ends.emplace(particles, this->Rows, "", options, ranks, executor, parts);
  if (forces && !this->Ends->have_forces())
  {
    notices.push_back({ {},
      "the contacts have neither an array 'force' nor 'force_normal': stress and pressure lack "
      "their part" });
  }
  const std::int64_t unplaced = this->Ends->unplaced();
  this->LeftOut = { this->Ends->missing() - unplaced, unplaced, this->Ends->broken() };
  ranks.sum(this->LeftOut);
}
}
