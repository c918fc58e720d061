// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularAlgorithm
 * @brief   Base class of sources and filters that work on many threads and ranks.
 *
 * After an error all outputs are empty and GetErrorCode() is not vtkErrorCode::NoError. A request to abort holds for one update:
 * that update gives empty outputs, and the next one starts afresh.
 */

#ifndef vtkGranularAlgorithm_h
#define vtkGranularAlgorithm_h

#include "vtkDataObjectAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

#include <memory> // for std::unique_ptr

class vtkMultiProcessController;

namespace vtkGranularPrivate
{
class Processes;
}

class VTKGRANULAR_EXPORT vtkGranularAlgorithm : public vtkDataObjectAlgorithm
{
public:
  vtkTypeMacro(vtkGranularAlgorithm, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How many threads work. 0, the default: the cores of the machine, divided by the processes of the Controller that run on
   * it. Changes no result. Below 0 is an error and changes nothing.
   */
  void SetThreads(int threads);
  vtkGetMacro(Threads, int);
  ///@}

  ///@{
  /**
   * The processes that work together, each with its part of the inputs and of the output: all of them must set it, set the same
   * properties, and update together. What goes wrong on one of them is an error of all. The global controller by default;
   * null: this process is alone, whatever others do.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  /**
   * Stops the update that comes next, or that is running, on all processes of the Controller.
   */
  void SetAbortExecute(vtkTypeBool abort) override;

  /**
   * Returns the error of the last update, as it was told, or an empty text if there was none.
   */
  const char* GetErrorMessage();

protected:
  vtkGranularAlgorithm();
  ~vtkGranularAlgorithm() override;

  int ComputePipelineMTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector, int requestFromOutputPort, vtkMTimeType* mtime) override;

  /**
   * Tells that all outputs can be had in pieces.
   */
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * Asks for the piece of the inputs that this process has. Who is asked for another one than its own makes that from the
   * whole.
   */
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * Fills the outputs. Called by all processes together; may throw what the core does.
   */
  virtual void Execute(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) = 0;

  /**
   * Asks all inputs for a piece, without ghosts.
   */
  void AskFor(vtkInformationVector** inputVector, int piece, int pieces);

  int Threads = 0;
  const std::unique_ptr<vtkGranularPrivate::Processes> Ranks;

private:
  vtkGranularAlgorithm(const vtkGranularAlgorithm&) = delete;
  void operator=(const vtkGranularAlgorithm&) = delete;
};

#endif
