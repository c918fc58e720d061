// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularGuard_h
#define vtkGranularGuard_h

#include "granular/common/progress.h"
#include "granular/parallel/communicator.h"

#include <exception>
#include <string>

class vtkAlgorithm;
class vtkInformationVector;

namespace vtkGranularPrivate
{
/**
 * Empties the data object of every output.
 */
void EmptyOutputs(vtkInformationVector* outputs);

/**
 * Calls vtkAlgorithm::SetErrorCode, which is protected.
 */
void SetErrorCode(vtkAlgorithm* self, unsigned long code);

/**
 * What a request came to.
 */
enum class Outcome
{
  Done,
  Cancelled,
  Failed,
  Refused ///< failed because the system refused a file: it may give it another time
};

/**
 * Reports an exception of the core in VTK's terms: vtkErrorMacro with its text and the fitting error
 * code, or, if the task was cancelled, the mark of an aborted output. Empties the outputs.
 */
Outcome ReportException(
  vtkAlgorithm* self, vtkInformationVector* outputs, const std::exception_ptr& exception);

/**
 * The one place where exceptions end: runs the task of a request, which all ranks have, and which may be collective. If a rank
 * throws, all report the same error: the ranks agree at the end of the task, too.
 */
template <typename Ranks, typename Task>
Outcome Guard(vtkAlgorithm* self, Ranks& ranks, vtkInformationVector* outputs, Task&& task)
{
  try
  {
    granular::do_together(ranks.Get(), task);
    SetErrorCode(self, 0);
    return Outcome::Done;
  }
  catch (...)
  {
    return ReportException(self, outputs, std::current_exception());
  }
}

/**
 * Hands the progress of a task of the core to an algorithm, and the wish to stop back.
 */
class AlgorithmProgress : public granular::Progress
{
public:
  explicit AlgorithmProgress(vtkAlgorithm* self)
    : Self(self)
  {
  }

  bool report(double fraction) override;

private:
  vtkAlgorithm* Self;
};
}

#endif
