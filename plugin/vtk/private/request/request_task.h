// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularRequestTask_h
#define vtkGranularRequestTask_h

#include "private/request/guard.h"
#include "private/request/processes.h"

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/parallel/communicator.h"

#include "vtkType.h"

#include <string>
#include <utility>
#include <vector>

class vtkAlgorithm;
class vtkDataObject;
class vtkGranularAlgorithm;
class vtkInformation;
class vtkInformationVector;

namespace vtkGranularPrivate
{
/**
 * The part of a pipeline's piece that an output requests.
 */
struct PieceRequest
{
  int Piece = 0;
  int Pieces = 1;

  static PieceRequest Of(vtkInformation* output);

  /**
   * Returns the part that the output requests through which a request came.
   */
  static PieceRequest Of(vtkInformation* request, vtkInformationVector* outputs);

  /**
   * Returns the part [first, last) of `count` things that belongs to the piece.
   */
  std::pair<vtkTypeInt64, vtkTypeInt64> RangeOf(vtkTypeInt64 count) const;
};

/**
 * Lets ParaView's ranks keep the pieces that they request, where a reader finds new frames within an update. Call in
 * RequestInformation.
 *
 * UpdatePipeline of ParaView asks for information, sets the piece of the rank, and updates, which asks for information
 * again. If a file has changed in between, information is made anew, and VTK then sets the request to the whole: each rank
 * would read every particle. A key on the outputs goes downstream with the information, notes the pieces before VTK
 * overwrites them, and sets them again when the time is requested, which is the next step.
 */
void KeepPieces(vtkAlgorithm* self, vtkInformationVector* outputs);

/**
 * Forgets the pieces of earlier requests of an output. Call after UpdateInformation, before another piece is requested.
 */
void ForgetPieces(vtkInformation* output);

/**
 * Returns the piece of an input that a rank needs: its own, or the whole to extract another piece from.
 */
PieceRequest PieceOfInput(const PieceRequest& wanted, const granular::Communicator& ranks);

/**
 * The task of a filter in one request for data, which all ranks do together. All functions may throw the core's errors.
 */
class RequestTask
{
public:
  /**
   * Throws UnsupportedError if only some ranks request their own piece of the whole, unless they may differ. Collective.
   */
  RequestTask(vtkGranularAlgorithm* self, vtkInformation* request, vtkInformationVector** inputs,
    vtkInformationVector* outputs, bool mayDiffer = false);
  virtual ~RequestTask() = default;
  RequestTask(const RequestTask&) = delete;
  void operator=(const RequestTask&) = delete;

  /**
   * Executes the task, then warns of what the user should know. Collective.
   */
  void Run();

protected:
  /**
   * Fills the outputs. Collective.
   */
  virtual void Execute() = 0;

  /**
   * Returns the data of an input port; null if it has no connection.
   */
  vtkDataObject* GetInput(int port) const;

  vtkInformation* GetOutputInformation() const;

  template <class Data>
  Data* GetOutput(int port = 0) const
  {
    return Data::GetData(this->Outputs, port);
  }

  /**
   * Returns the part [first, last) of `count` things made here that this rank puts out.
   */
  std::pair<vtkTypeInt64, vtkTypeInt64> RangeOf(vtkTypeInt64 count) const;

  /**
   * Warns at the end, if a condition that all ranks know holds: see Processes::Warn.
   */
  void Tell(bool holds, const std::string& topic, const std::string& text);

private:
  vtkGranularAlgorithm* Algorithm;
  vtkInformationVector** Inputs;
  vtkInformationVector* Outputs;
  granular::SerialCommunicator Alone;
  AlgorithmProgress AlgorithmReport;
  granular::SharedProgress RankReport;
  std::vector<Processes::Remark> Remarks;

protected:
  granular::Communicator& Ranks; ///< all ranks of the Controller
  const PieceRequest Wanted;
  const bool Together;           ///< each rank requests its own piece
  granular::Communicator& Group; ///< the ranks that make one whole: all, or this one alone
  const int Threads;
  granular::PartialProgress Progress;
  granular::Notices Notices; ///< warnings at the end
};

/**
 * A task with the filter whose properties it reads.
 */
template <class Filter, class Base = RequestTask>
class FilterTask : public Base
{
public:
  template <class... Arguments>
  explicit FilterTask(Filter* self, Arguments... arguments)
    : Base(self, arguments...)
    , Self(self)
  {
  }

protected:
  Filter* const Self;
};
}

/**
 * Defines the method Execute of a filter, which runs the filter's Task. Further arguments are the last ones of a RequestTask.
 */
#define vtkGranularExecuteMacro(Filter, ...)                                               \
  void Filter::Execute(                                                                    \
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) \
  {                                                                                        \
    Task(this, request, inputs, outputs __VA_OPT__(, ) __VA_ARGS__).Run();                 \
  }

/**
 * Defines a method of an algorithm that returns the data of an output port.
 */
#define vtkGranularOutputMacro(Algorithm, Method, Data, port)   \
  Data* Algorithm::Method()                                     \
  {                                                             \
    return Data::SafeDownCast(this->GetOutputDataObject(port)); \
  }

#endif
