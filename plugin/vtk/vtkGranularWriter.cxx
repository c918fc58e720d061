// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularWriter.h"

#include "private/guard.h"
#include "private/writer.h"

#include "vtkDataObject.h"
#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <string>

using namespace vtkGranularPrivate;

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;
}

//------------------------------------------------------------------------------
granular::Communicator& vtkGranularWriter::Internals::GetRanks()
{
  if (!this->Ranks)
  {
    this->Ranks = MakeRanks(this->Controller);
  }
  return *this->Ranks;
}

//------------------------------------------------------------------------------
// Of the processes the first one speaks.
void vtkGranularWriter::Internals::Tell(vtkGranularWriter* self, const granular::Notices& notices)
{
  for (const granular::Notice& notice : notices)
  {
    const std::string text = granular::to_string(notice);
    if (this->Told.insert(text).second && (!this->Ranks || this->Ranks->rank() == 0))
    {
      vtkWarningWithObjectMacro(self, << text);
    }
  }
}

//------------------------------------------------------------------------------
vtkGranularWriter::vtkGranularWriter()
  : Shared(std::make_unique<Internals>())
{
  this->Shared->Controller = vtkMultiProcessController::GetGlobalController();
}

//------------------------------------------------------------------------------
vtkGranularWriter::~vtkGranularWriter()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
void vtkGranularWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "WriteTimeSteps: " << this->WriteTimeSteps << "\n";
  os << indent << "ParallelMode: " << this->ParallelMode << "\n";
  os << indent << "Threads: " << this->Threads << "\n";
  os << indent << "GhostLevel: " << this->GhostLevel << "\n";
}

//------------------------------------------------------------------------------
void vtkGranularWriter::SetParallelMode(int mode)
{
  if (mode != GATHER && mode != MPI_IO)
  {
    vtkErrorMacro("expected ParallelMode 0 (Gather) or 1 (MPI-IO), got " << mode);
    return;
  }
  if (this->ParallelMode != mode)
  {
    this->ParallelMode = mode;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGranularWriter::SetThreads(int threads)
{
  if (threads < 0)
  {
    vtkErrorMacro("expected Threads of at least 0, got " << threads);
    return;
  }
  if (this->Threads != threads)
  {
    this->Threads = threads;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGranularWriter::SetController(vtkMultiProcessController* controller)
{
  if (this->Shared->Controller != controller)
  {
    this->Shared->Controller = controller;
    this->Shared->Ranks.reset();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkMultiProcessController* vtkGranularWriter::GetController()
{
  return this->Shared->Controller;
}

//------------------------------------------------------------------------------
int vtkGranularWriter::Write()
{
  Internals& shared = *this->Shared;
  shared.File.reset();
  shared.Frame = 0;
  this->Written = false;
  shared.Told.clear();
  this->SetErrorCode(vtkErrorCode::NoError);
  this->Superclass::Write();
  shared.File.reset(); // what is not finished leaves nothing
  if (!this->Written && this->GetErrorCode() == vtkErrorCode::NoError && !this->GetAbortOutput())
  {
    vtkErrorMacro("nothing is written to '" << (this->FileName ? this->FileName : "")
                                            << "': the input could not be made");
    this->SetErrorCode(vtkErrorCode::UnknownError);
  }
  return this->Written ? 1 : 0;
}

//------------------------------------------------------------------------------
vtkTypeBool vtkGranularWriter::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  Internals& shared = *this->Shared;
  vtkInformation* input = inputVector[0]->GetInformationObject(0);
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    shared.Times.clear();
    if (this->WriteTimeSteps && input && input->Has(Pipeline::TIME_STEPS()))
    {
      const double* times = input->Get(Pipeline::TIME_STEPS());
      shared.Times.assign(times, times + input->Length(Pipeline::TIME_STEPS()));
    }
    return 1;
  }
  if (request->Has(Pipeline::REQUEST_UPDATE_EXTENT()))
  {
    vtkMultiProcessController* controller = shared.Controller;
    input->Set(Pipeline::UPDATE_PIECE_NUMBER(), controller ? controller->GetLocalProcessId() : 0);
    input->Set(
      Pipeline::UPDATE_NUMBER_OF_PIECES(), controller ? controller->GetNumberOfProcesses() : 1);
    input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), this->GhostLevel);
    if (shared.Frame < shared.Times.size())
    {
      if (shared.Frame == 0 && input->Has(Pipeline::UPDATE_TIME_STEP()))
      {
        shared.TimeBefore = input->Get(Pipeline::UPDATE_TIME_STEP());
      }
      input->Set(Pipeline::UPDATE_TIME_STEP(), shared.Times[shared.Frame]);
    }
    return 1;
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkGranularWriter::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  Internals& shared = *this->Shared;
  granular::Notices notices;
  const std::size_t frames = std::max<std::size_t>(1, shared.Times.size());
  const Outcome outcome = Guard(this, outputVector,
    [&]
    {
      if (shared.Frame == 0)
      {
        if (!this->FileName || !*this->FileName)
        {
          throw granular::IoError("no file to write: set FileName first");
        }
        shared.File = this->OpenFile(shared);
      }
      vtkDataObject* input = vtkDataObject::GetData(inputVector[0]);
      FrameTime time;
      time.Frame = static_cast<vtkTypeInt64>(shared.Frame);
      if (input && input->GetInformation()->Has(vtkDataObject::DATA_TIME_STEP()))
      {
        time.Time = input->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP());
      }
      AlgorithmProgress progress(this);
      granular::PartialProgress part(progress);
      const auto all = static_cast<double>(frames);
      part.set_part(
        static_cast<double>(shared.Frame) / all, static_cast<double>(shared.Frame + 1) / all);
      shared.File->Write(input, time, notices, part);
      if (++shared.Frame == frames)
      {
        shared.File->Finish();
        this->Written = true;
      }
    });
  shared.Tell(this, notices);
  if (outcome == Outcome::Done && !this->Written)
  {
    request->Set(Pipeline::CONTINUE_EXECUTING(), 1);
    return 1;
  }
  request->Remove(Pipeline::CONTINUE_EXECUTING());
  shared.File.reset();
  if (shared.TimeBefore)
  {
    // who writes next means the time that is shown, not the last that was written
    inputVector[0]->GetInformationObject(0)->Set(Pipeline::UPDATE_TIME_STEP(), *shared.TimeBefore);
    shared.TimeBefore.reset();
  }
  return outcome == Outcome::Done ? 1 : 0;
}
