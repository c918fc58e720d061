// SPDX-License-Identifier: BSD-3-Clause
#include "private/euler/average_contacts.h"

#include "private/contacts/contact_input.h"

#include "granular/contacts/contact_cells.h"
#include "granular/contacts/find_ends.h"

#include "vtkPointSet.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace vtkGranularPrivate
{
ContactsLeft AverageContacts(const std::array<vtkDataObject*, 2>& inputs,
  const granular::FrameView& particles, const granular::EulerAverageRequest& request, bool forces,
  granular::Communicator& ranks, const granular::Executor& executor, granular::Progress& progress,
  granular::EulerAverages& averages)
{
  constexpr Touched touched[] = { Touched::Particles, Touched::Walls };
  std::array<std::optional<ContactInput>, 2> contacts;
  std::vector<granular::ContactRows> rows;
  for (std::size_t port = 0; port < inputs.size(); ++port)
  {
    if (inputs[port])
    {
      ContactArrays wanted;
      wanted.Force = forces;
      wanted.Point = port == 1 && !vtkPointSet::SafeDownCast(inputs[port]); // where the wall is
      contacts[port].emplace(inputs[port], touched[port], wanted, progress);
      rows.push_back(contacts[port]->GetRows());
    }
  }
  granular::ContactOptions options;
  options.arm = granular::LeverArm::Half; // nobody asks where forces act
  granular::PartialProgress parts(progress);
  parts.set_part(0, 0.3);
  const granular::FoundEnds ends(
    particles, rows, request.arrays.radius, options, ranks, executor, parts);
  parts.set_part(0.3, 1);
  granular::average_contacts(ends, particles.has_box ? &particles.header.box : nullptr, request,
    ranks, executor, parts, averages);
  std::array<std::int64_t, 2> left = { ends.missing(), ends.broken() };
  ranks.sum(left);
  return { left[0], left[1] };
}
}
