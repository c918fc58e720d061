// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularProcesses_h
#define vtkGranularProcesses_h

#include "private/request/guard.h"
#include "private/request/ranks.h"

#include "granular/parallel/communicator.h"

#include "vtkSmartPointer.h"

#include <memory>

class vtkAlgorithm;
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

private:
  vtkSmartPointer<vtkMultiProcessController> Controller;
  std::unique_ptr<granular::Communicator> Ranks; ///< null: not made yet
  bool Cancelled = false;
  bool Refused = false; ///< the last request failed, but may succeed if it is made again
};
}

#endif
