// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularAlgorithm
 * @brief   Base class of readers, sources and filters that work on many threads and ranks.
 *
 * After an error all outputs are empty and GetErrorCode() is not vtkErrorCode::NoError. A request to abort holds for one update:
 * that update gives empty outputs, and the next one starts afresh.
 */

#ifndef vtkGranularAlgorithm_h
#define vtkGranularAlgorithm_h

#include "vtkDataObjectAlgorithm.h"
#include "vtkGranularModule.h" // For export macro

#include <initializer_list> // for SetPorts
#include <memory>           // for std::unique_ptr

class vtkMultiProcessController;

/**
 * Defines the function that sets a property to a number in a range; another one is an error and changes nothing.
 */
#define vtkGranularSetRangeMacro(name, type, least, most)                   \
  virtual void Set##name(type value)                                        \
  {                                                                         \
    if (this->CheckRange(#name, value, least, most) && this->name != value) \
    {                                                                       \
      this->name = value;                                                   \
      this->Modified();                                                     \
    }                                                                       \
  }

namespace vtkGranularPrivate
{
class Processes;
class RequestTask;
}

class VTKGRANULAR_EXPORT vtkGranularAlgorithm : public vtkDataObjectAlgorithm
{
public:
  vtkTypeMacro(vtkGranularAlgorithm, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Sets the number of threads. 0, the default: the cores of the machine, divided by the ranks of the Controller on it.
   * The number changes no result. Numbers below 0 are an error and change nothing.
   */
  void SetThreads(int threads);
  vtkGetMacro(Threads, int);
  ///@}

  ///@{
  /**
   * Sets the ranks that work together, each with its part of the inputs and the output. All of them must set the
   * controller and the same properties, and update together. An error on one rank is an error on all. Default: the global
   * controller; null: this rank works alone.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  /**
   * Stops the next or the running update, on all ranks of the Controller.
   */
  void SetAbortExecute(vtkTypeBool abort) override;

  /**
   * Returns the error of the last update, or an empty text if there was none.
   */
  const char* GetErrorMessage();

protected:
  vtkGranularAlgorithm();
  ~vtkGranularAlgorithm() override;

  enum class Input
  {
    Required,
    Optional
  };

  /**
   * Sets the ports, by the types of the outputs. Inputs are data objects of any type: all ranks look at them together, and
   * fail together. A composite is not handed over block by block, with which ranks would wait for each other.
   */
  void SetPorts(std::initializer_list<Input> inputs, std::initializer_list<const char*> outputs);

  int ComputePipelineMTime(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector, int requestFromOutputPort, vtkMTimeType* mtime) override;

  /**
   * Announces that all outputs come in pieces.
   */
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * Asks the inputs for the piece of this rank. If asked for another piece, the algorithm makes it from the whole.
   */
  int RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  /**
   * Fills the outputs. Collective; may throw the core's errors.
   */
  virtual void Execute(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) = 0;

  /**
   * Tells an error and returns false unless a number is in a range.
   */
  bool CheckRange(const char* name, vtkTypeInt64 value, vtkTypeInt64 least, vtkTypeInt64 most);

  /**
   * Asks all inputs for a piece, without ghosts.
   */
  void AskFor(vtkInformationVector** inputVector, int piece, int pieces);

  int Threads = 0;
  const std::unique_ptr<vtkGranularPrivate::Processes> Ranks;

private:
  vtkGranularAlgorithm(const vtkGranularAlgorithm&) = delete;
  void operator=(const vtkGranularAlgorithm&) = delete;

  friend class vtkGranularPrivate::RequestTask;
};

#endif
