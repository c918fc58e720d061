// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularRanks_h
#define vtkGranularRanks_h

#include "granular/parallel/communicator.h"

#include <memory>

class vtkMultiProcessController;

namespace vtkGranularPrivate
{
/**
 * Returns the ranks of a controller, all of which must call this; a single rank if there is no controller or it is not
 * an MPI controller.
 */
std::unique_ptr<granular::Communicator> MakeRanks(vtkMultiProcessController* controller);

/**
 * Returns the number of threads of a rank: the requested number, or for 0 its share of the cores of the machine, and at
 * most the cores that it may run on.
 */
int ChooseThreads(int wanted, const granular::Communicator& ranks);
}

#endif
