// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularRanks_h
#define vtkGranularRanks_h

#include "granular/parallel/communicator.h"

#include <memory>

class vtkMultiProcessController;

namespace vtkGranularPrivate
{
/**
 * The processes of a controller, who all call this. One alone where there is no controller, or one of
 * another kind than MPI.
 */
std::unique_ptr<granular::Communicator> MakeRanks(vtkMultiProcessController* controller);

/**
 * How many threads a rank has: those that are wanted, or for 0 its share of the cores of the machine,
 * at most those that it may run on.
 */
int ChooseThreads(int wanted, const granular::Communicator& ranks);
}

#endif
