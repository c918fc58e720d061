// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularAbort_h
#define vtkGranularAbort_h

#include "vtkAlgorithm.h"
#include "vtkInformation.h"

namespace vtkGranularPrivate
{
/**
 * Returns true if the user has asked the algorithm to stop. VTK 9.1 asks the algorithm itself alone, later versions
 * the pipeline behind it as well.
 */
template <typename Algorithm>
bool AskedToStop(Algorithm* self)
{
  if constexpr (requires { self->CheckAbort(); })
  {
    return self->CheckAbort();
  }
  else
  {
    return self->GetAbortExecute() != 0;
  }
}

/**
 * Returns true if the output that an information belongs to is marked so.
 */
template <typename Algorithm>
bool IsMarkedStopped(vtkInformation* output)
{
  if constexpr (requires { Algorithm::ABORTED(); })
  {
    return output->Get(Algorithm::ABORTED()) != 0;
  }
  else
  {
    return false;
  }
}

/**
 * Marks the outputs of the algorithm as those of one that was stopped, or not. VTK 9.1 has no such mark.
 */
template <typename Algorithm>
void MarkStopped(Algorithm* self, bool stopped)
{
  if constexpr (requires { self->SetAbortOutput(stopped); })
  {
    self->SetAbortOutput(stopped);
  }
}
}

#endif
