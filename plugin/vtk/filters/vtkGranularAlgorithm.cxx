// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularAlgorithm.h"

#include "private/request/processes.h"
#include "private/request/request_task.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
vtkGranularAlgorithm::vtkGranularAlgorithm()
  : Ranks(std::make_unique<Processes>())
{
}

//------------------------------------------------------------------------------
vtkGranularAlgorithm::~vtkGranularAlgorithm() = default;

//------------------------------------------------------------------------------
void vtkGranularAlgorithm::SetPorts(
  std::initializer_list<Input> inputs, std::initializer_list<const char*> outputs)
{
  this->SetNumberOfInputPorts(static_cast<int>(inputs.size()));
  this->SetNumberOfOutputPorts(static_cast<int>(outputs.size()));
  int port = 0;
  for (const Input input : inputs)
  {
    vtkInformation* info = this->GetInputPortInformation(port++);
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), input == Input::Optional ? 1 : 0);
  }
  port = 0;
  for (const char* type : outputs)
  {
    this->GetOutputPortInformation(port++)->Set(vtkDataObject::DATA_TYPE_NAME(), type);
  }
}

//------------------------------------------------------------------------------
void vtkGranularAlgorithm::SetThreads(int threads)
{
  if (this->CheckRange("Threads", threads, 0, VTK_INT_MAX))
  {
    this->Threads = threads; // changes no result: nothing is to be made again
  }
}

//------------------------------------------------------------------------------
bool vtkGranularAlgorithm::CheckRange(
  const char* name, vtkTypeInt64 value, vtkTypeInt64 least, vtkTypeInt64 most)
{
  if (value >= least && value <= most)
  {
    return true;
  }
  if (most < VTK_INT_MAX)
  {
    vtkErrorMacro(<< name << " must be from " << least << " to " << most << ", got " << value);
  }
  else
  {
    vtkErrorMacro(<< name << " must be at least " << least << ", got " << value);
  }
  return false;
}

//------------------------------------------------------------------------------
void vtkGranularAlgorithm::SetController(vtkMultiProcessController* controller)
{
  if (this->Ranks->SetController(controller))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkMultiProcessController* vtkGranularAlgorithm::GetController()
{
  return this->Ranks->GetController();
}

//------------------------------------------------------------------------------
const char* vtkGranularAlgorithm::GetErrorMessage()
{
  return this->Ranks->GetMessage().c_str();
}

//------------------------------------------------------------------------------
// Modifies nothing: else, asked on one rank of many, that rank alone would start again, and wait for ever.
void vtkGranularAlgorithm::SetAbortExecute(vtkTypeBool abort)
{
  this->AbortExecute = abort;
}

//------------------------------------------------------------------------------
int vtkGranularAlgorithm::ComputePipelineMTime(vtkInformation* request,
  vtkInformationVector** inputVector, vtkInformationVector* outputVector, int requestFromOutputPort,
  vtkMTimeType* mtime)
{
  this->Ranks->BeginUpdate(this);
  return this->Superclass::ComputePipelineMTime(
    request, inputVector, outputVector, requestFromOutputPort, mtime);
}

//------------------------------------------------------------------------------
int vtkGranularAlgorithm::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  for (int port = 0; port < outputVector->GetNumberOfInformationObjects(); ++port)
  {
    outputVector->GetInformationObject(port)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkGranularAlgorithm::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (this->GetNumberOfInputPorts() > 0)
  {
    const PieceRequest wanted = PieceRequest::Of(request, outputVector);
    const PieceRequest piece = PieceOfInput(wanted, this->Ranks->Get());
    this->AskFor(inputVector, piece.Piece, piece.Pieces);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkGranularAlgorithm::AskFor(vtkInformationVector** inputVector, int piece, int pieces)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* info = inputVector[port]->GetInformationObject(i);
      info->Set(Pipeline::UPDATE_PIECE_NUMBER(), piece);
      info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), pieces);
      info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
}

//------------------------------------------------------------------------------
int vtkGranularAlgorithm::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const Outcome outcome = Guard(
    this, *this->Ranks, outputVector, [&] { this->Execute(request, inputVector, outputVector); });
  return this->Ranks->EndRequest(this, outcome);
}

//------------------------------------------------------------------------------
void vtkGranularAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Threads: " << this->Threads << "\n";
  os << indent << "Controller: " << this->GetController() << "\n";
}
