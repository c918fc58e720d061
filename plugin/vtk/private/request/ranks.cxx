// SPDX-License-Identifier: BSD-3-Clause
#include "private/request/ranks.h"

#include "granular/parallel/executor.h"

#include "vtkMultiProcessController.h"

#if VTK_MODULE_ENABLE_VTK_ParallelMPI
#include "granular/mpi/mpi_communicator.h"

#include "vtkMPI.h"
#include "vtkMPICommunicator.h"
#endif

#include <algorithm>

namespace vtkGranularPrivate
{
std::unique_ptr<granular::Communicator> MakeRanks(vtkMultiProcessController* controller)
{
#if VTK_MODULE_ENABLE_VTK_ParallelMPI
  auto* mpi =
    controller ? vtkMPICommunicator::SafeDownCast(controller->GetCommunicator()) : nullptr;
  if (mpi && mpi->GetNumberOfProcesses() > 1)
  {
    return granular::MpiCommunicator::make(*mpi->GetMPIComm()->GetHandle());
  }
#else
  static_cast<void>(controller);
#endif
  return std::make_unique<granular::SerialCommunicator>();
}

int ChooseThreads(int wanted, const granular::Communicator& ranks)
{
  if (wanted > 0)
  {
    return wanted;
  }
  // a rank that is bound to some cores has these for itself
  return std::clamp(granular::machine_cores() / ranks.node_size(), 1, granular::available_cores());
}
}
