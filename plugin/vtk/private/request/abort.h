// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularAbort_h
#define vtkGranularAbort_h

#include "vtkAlgorithm.h"
#include "vtkInformation.h"

namespace vtkGranularPrivate
{
/**
 * Returns true if the user has asked the algorithm to stop. VTK 9.1 asks only the algorithm itself, later versions also
 * the pipeline behind it.
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
 * Returns true if the output of an information is marked as aborted.
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
 * Marks the outputs of the algorithm as aborted, or not. VTK 9.1 has no such mark.
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
