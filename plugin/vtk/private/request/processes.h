// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularProcesses_h
#define vtkGranularProcesses_h

#include "private/request/guard.h"
#include "private/request/ranks.h"

#include "granular/parallel/communicator.h"

#include "vtkCallbackCommand.h"
#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <memory>
#include <string>

class vtkAlgorithm;
class vtkExecutive;
class vtkMultiProcessController;

namespace vtkGranularPrivate
{
/**
 * The processes that do the requests of an algorithm together, and how the last request ended.
 */
class Processes
{
public:
  /**
   * Those of the global controller.
   */
  Processes();
  ~Processes();

  vtkMultiProcessController* GetController() const;

  /**
   * False: they are those of before.
   */
  bool SetController(vtkMultiProcessController* controller);

  /**
   * Collective when it is called first.
   */
  granular::Communicator& Get();

  /**
   * To be called in ComputePipelineMTime, the first call of every update. A request to abort holds for one update, and
   * observers of progress may make it again while the pipeline leaves the aborted one: it is forgotten
   * here, and what was aborted is done again; so is a request that the system refused a file for.
   */
  void BeginUpdate(vtkAlgorithm* self);

  /**
   * What is left to do when a request is done with. Returns what the request returns.
   */
  int EndRequest(vtkAlgorithm* self, Outcome outcome);

  /**
   * Whether the last request was.
   */
  bool IsCancelled() const { return this->Cancelled; }

  /**
   * Forgets the last failure: a request succeeded, or begins afresh.
   */
  void Forget(vtkAlgorithm* self);

  /**
   * Tells a failure as an error of the algorithm, and keeps the executive from adding that the algorithm failed. A failure
   * that was told is not told again until it is forgotten or the algorithm is modified: pipelines ask again and again.
   */
  Outcome Fail(vtkAlgorithm* self, const Failure& failure);

  /**
   * The error of the last request; empty if there was none.
   */
  const std::string& GetMessage() const { return this->Message; }

private:
  void Quiet(vtkExecutive* executive);

  vtkSmartPointer<vtkMultiProcessController> Controller;
  std::unique_ptr<granular::Communicator> Ranks; ///< null: not made yet
  bool Cancelled = false;
  bool Refused = false; ///< the last request failed, but may succeed if it is made again
  std::string Message;
  std::string Told;          ///< the last error that was told
  vtkMTimeType ToldTime = 0; ///< MTime of the algorithm then
  vtkSmartPointer<vtkCallbackCommand> Quieter;
};
}

#endif
