// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularProcesses_h
#define vtkGranularProcesses_h

#include "private/request/guard.h"

#include "granular/parallel/communicator.h"

#include "vtkCallbackCommand.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <memory>
#include <set>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkExecutive;
class vtkMultiProcessController;

namespace vtkGranularPrivate
{
/**
 * The ranks that handle the requests of an algorithm together, and the result of the last request.
 */
class Processes
{
public:
  /**
   * Uses the ranks of the global controller.
   */
  Processes();
  ~Processes();

  vtkMultiProcessController* GetController() const;

  /**
   * Sets the controller. Returns false if it is unchanged.
   */
  bool SetController(vtkMultiProcessController* controller);

  /**
   * Returns the ranks. The first call is collective.
   */
  granular::Communicator& Get();

  /**
   * Begins an update; call in ComputePipelineMTime, the first call of every update. A request to abort holds for one
   * update, and observers of progress may repeat it while the pipeline leaves the aborted one. It is forgotten here,
   * and the aborted work is done again. The same holds for a request that failed because the system refused access to a
   * file.
   */
  void BeginUpdate(vtkAlgorithm* self);

  /**
   * Finishes a request. Returns the value that the request must return.
   */
  int EndRequest(vtkAlgorithm* self, Outcome outcome);

  /**
   * Returns true if the last request failed.
   */
  bool IsCancelled() const { return this->Cancelled; }

  /**
   * Forgets the last failure, because a request succeeded or starts again.
   */
  void Forget(vtkAlgorithm* self);

  /**
   * Reports a failure as an error of the algorithm, and keeps the executive from adding that the algorithm failed. A
   * reported failure is not reported again until it is forgotten or the algorithm is modified, because pipelines repeat
   * requests.
   */
  Outcome Fail(vtkAlgorithm* self, const Failure& failure);

  /**
   * A fact that a user should know of the output.
   */
  struct Remark
  {
    std::string Topic; ///< the same for any numbers in the text
    std::string Text;
  };

  /**
   * Warns of all that is to be said after a request, of each topic once, until it is gone, or another input or property may
   * be why.
   */
  void Warn(vtkAlgorithm* self, const std::vector<Remark>& remarks);

  /**
   * Returns the error of the last request; empty if there was none.
   */
  const std::string& GetMessage() const { return this->Message; }

private:
  void Quiet(vtkExecutive* executive);

  vtkSmartPointer<vtkMultiProcessController> Controller;
  std::unique_ptr<granular::Communicator> Ranks; ///< null: not made yet
  bool Cancelled = false;
  bool Refused = false; ///< the last request failed, but may succeed if it is made again
  std::string Message;
  std::string LastError;      ///< that was reported
  vtkMTimeType ErrorTime = 0; ///< MTime of the algorithm then
  vtkSmartPointer<vtkCallbackCommand> Quieter;
  std::set<std::string> Warned; ///< topics of the last request
  vtkMTimeType WarnedTime = 0;  ///< of the pipeline then
};

/**
 * Returns the number of threads of a rank: the requested number, or for 0 its share of the cores of the machine, and at
 * most the cores that it may run on.
 */
int ChooseThreads(int wanted, const granular::Communicator& ranks);
}

#endif
