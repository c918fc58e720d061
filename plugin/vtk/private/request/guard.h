// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularGuard_h
#define vtkGranularGuard_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/parallel/communicator.h"

#include "vtkAlgorithm.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"

#include <exception>
#include <string>

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
 * The result of a request.
 */
enum class Outcome
{
  Done,
  Cancelled,
  Failed,
  Refused ///< failed because the system refused a file or memory: it may give it another time
};

/**
 * The end of a request that threw: the text of the error, or none if it was cancelled.
 */
struct Failure
{
  Outcome End = Outcome::Failed;
  unsigned long Code = 0; ///< of vtkErrorCode
  std::string Text;
};

/**
 * Converts an exception of the core to VTK's terms.
 */
Failure DescribeException(const std::exception_ptr& exception);

/**
 * Runs the task of a request, which all ranks have and which may be collective; the only place where exceptions end. If
 * a rank throws, all ranks report the same error and all outputs are empty: the ranks also agree at the end of the
 * task.
 */
template <typename Ranks, typename Task>
Outcome Guard(vtkAlgorithm* self, Ranks& ranks, vtkInformationVector* outputs, Task&& task)
{
  try
  {
    granular::do_together(ranks.Get(), task);
    ranks.Forget(self);
    return Outcome::Done;
  }
  catch (...)
  {
    EmptyOutputs(outputs);
    return ranks.Fail(self, DescribeException(std::current_exception()));
  }
}

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

/**
 * Passes the progress of a task of the core to an algorithm, and the user's wish to stop back.
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

/**
 * Returns the input as a data set of a type. Throws UnsupportedError if it has another type, with the expected one ("a
 * vtkPointSet to write") and the actual one.
 */
template <typename Type>
Type* ExpectData(vtkDataObject* input, const char* expected, const granular::Where& where = {})
{
  Type* const data = Type::SafeDownCast(input);
  if (!data)
  {
    const bool composite = vtkCompositeDataSet::SafeDownCast(input) != nullptr;
    throw granular::UnsupportedError("expected " + std::string(expected) + ", got " +
        (input ? std::string("a ") + input->GetClassName() : "nothing") +
        (composite ? ": the filter MergeBlocks makes one of it" : ""),
      where);
  }
  return data;
}

/**
 * Runs a function on a file, and names the file in errors.
 */
template <typename Work>
void NameFile(granular::Where where, const Work& work)
{
  try
  {
    work();
  }
  catch (const granular::UnsupportedError& error)
  {
    where.column = error.where().column;
    throw granular::UnsupportedError(error.text(), where);
  }
  catch (const granular::FormatError& error)
  {
    where.column = error.where().column;
    throw granular::FormatError(error.text(), where);
  }
}
}

#endif
