// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_contact_cells_h
#define granular_averages_contact_cells_h

#include "granular/averages/average.h"
#include "granular/common/progress.h"
#include "granular/contacts/find_ends.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"

namespace granular
{
/// Adds the contacts to averages in cells: their stress, which is branch_a force_b over the volume, shared among the cells along
/// the branch vector, by length or by the kernel of the request; with walls from the wall to the centre. Fields: contact stress;
/// coordination: ends of contacts that count (2, with a wall 1) over particles, both by their parts in the cell; fabric: mean
/// product of normals of these contacts, trace 1. With sums if the request keeps them, which coordination needs. Contacts without
/// forces have no stress: the fields are empty. What averages know of particles stays: see add_contact_stress.
///
/// contacts: of this rank; may be anywhere. Those without a line (see ContactEnds::has_line) are left out. Sums as
/// average_in_cells has them; terms of stresses are rounded to 2^-117 of the weakest contact, or less. Throws Error,
/// LimitError, Cancelled. Collective.
void average_contacts(const FoundEnds& contacts, const Box* box, const EulerAverageRequest& request,
  Communicator& ranks, const Executor& executor, Progress& progress, EulerAverages& averages);

/// Adds the contact stress to stress and pressure, and keeps what they were without it as the kinetic part.
void add_contact_stress(EulerCells& cells, EulerFields& fields);
}
#endif
