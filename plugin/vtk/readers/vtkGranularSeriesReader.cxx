// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularSeriesReader.h"

#include "private/readers/series_reader.h"
#include "private/request/guard.h"
#include "private/request/request_task.h"

#include "vtkCommand.h"
#include "vtkDataArraySelection.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cmath>
#include <string>
#include <vector>

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
vtkGranularSeriesReader::vtkGranularSeriesReader(std::unique_ptr<Internals> internals)
  : Series(std::move(internals))
{
  for (const ArrayChoice* choice : { &this->Series->Points, &this->Series->Cells })
  {
    choice->GetSelection()->AddObserver(
      vtkCommand::ModifiedEvent, this, &vtkGranularSeriesReader::Modified);
  }
}

//------------------------------------------------------------------------------
vtkGranularSeriesReader::~vtkGranularSeriesReader() = default;

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::AddFileName(const char* fileName)
{
  if (fileName && *fileName)
  {
    this->Series->FileNames.emplace_back(fileName);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::ClearFileNames()
{
  if (!this->Series->FileNames.empty())
  {
    this->Series->FileNames.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkGranularSeriesReader::GetNumberOfFileNames()
{
  return static_cast<int>(this->Series->FileNames.size());
}

//------------------------------------------------------------------------------
const char* vtkGranularSeriesReader::GetFileName(int index)
{
  return index >= 0 && index < this->GetNumberOfFileNames() ? this->Series->FileNames[index].c_str()
                                                            : nullptr;
}

//------------------------------------------------------------------------------
vtkDataArraySelection* vtkGranularSeriesReader::GetPointDataArraySelection()
{
  return this->Series->Points.GetSelection();
}

//------------------------------------------------------------------------------
vtkDataArraySelection* vtkGranularSeriesReader::GetCellDataArraySelection()
{
  return this->Series->Cells.GetSelection();
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Refresh()
{
  this->Series->Stale = true;
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::SetController(vtkMultiProcessController* controller)
{
  if (controller != this->GetController())
  {
    this->Series->Run =
      granular::Run(this->Series->Run.kind()); // the new ranks have none, or others
    this->Series->Valid = false;
    this->Superclass::SetController(controller);
  }
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::SetTimestepSize(double size)
{
  if (!std::isfinite(size) || size <= 0)
  {
    vtkErrorMacro("TimestepSize must be finite and greater than 0, got " << size);
    return;
  }
  if (this->TimestepSize != size)
  {
    this->TimestepSize = size;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
granular::RunOptions vtkGranularSeriesReader::Internals::MakeOptions()
{
  granular::RunOptions options;
  options.repeated_steps = static_cast<granular::RepeatedSteps>(this->Self->RepeatedSteps);
  options.threads = this->GetThreads();
  this->SetOptions(options);
  return options;
}

//------------------------------------------------------------------------------
// The first call of every update. Exceptions must not pass the pipeline: where it cannot be told whether files changed, the update that
// follows says why.
int vtkGranularSeriesReader::ComputePipelineMTime(vtkInformation* request,
  vtkInformationVector** inputVector, vtkInformationVector* outputVector, int requestFromOutputPort,
  vtkMTimeType* mtime)
{
  if (this->RefreshOnUpdate)
  {
    bool changed = true;
    try
    {
      changed = !this->Series->Valid ||
        granular::is_changed(this->Series->Run.index(), this->Series->GetRanks());
    }
    catch (const std::exception&)
    {
    }
    if (changed)
    {
      this->Refresh();
    }
  }
  return this->Superclass::ComputePipelineMTime(
    request, inputVector, outputVector, requestFromOutputPort, mtime);
}

//------------------------------------------------------------------------------
int vtkGranularSeriesReader::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  this->Superclass::RequestInformation(request, inputVector, outputVector);
  const auto forEachPort = [&](const auto& tell)
  {
    for (int port = 0; port < outputVector->GetNumberOfInformationObjects(); ++port)
    {
      tell(outputVector->GetInformationObject(port));
    }
  };
  const Outcome outcome = Guard(this, *this->Ranks, outputVector,
    [&]
    {
      forEachPort(
        [](vtkInformation* info)
        {
          info->Remove(Pipeline::TIME_STEPS());
          info->Remove(Pipeline::TIME_RANGE());
        });
      this->Series->Update();
      granular::Notices notices;
      const std::vector<double> times =
        this->Series->Run.index().times(this->TimestepSize, notices);
      if (this->Series->GetRanks().rank() == 0)
      {
        this->Series->Tell(notices, true);
      }
      const double range[] = { times.front(), times.back() };
      const auto count = static_cast<int>(times.size());
      forEachPort(
        [&](vtkInformation* info)
        {
          info->Set(Pipeline::TIME_STEPS(), times.data(), count);
          info->Set(Pipeline::TIME_RANGE(), range, 2);
        });
      KeepPieces(this, outputVector);
      this->Series->LookOnce();
      this->Series->Describe(outputVector);
    });
  return this->Ranks->EndRequest(this, outcome);
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Execute(vtkInformation* request,
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  if (this->Ranks->IsCancelled())
  {
    throw granular::Cancelled();
  }
  this->Series->ShowRequested(request, outputVector);
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileNames: " << this->GetNumberOfFileNames() << "\n";
  for (const std::string& name : this->Series->FileNames)
  {
    os << indent.GetNextIndent() << name << "\n";
  }
  os << indent << "RefreshOnUpdate: " << (this->RefreshOnUpdate ? "On" : "Off") << "\n";
  os << indent << "RepeatedSteps: " << this->RepeatedSteps << "\n";
  os << indent << "TimestepSize: " << this->TimestepSize << "\n";
  os << indent << "PointArrays:\n";
  this->Series->Points.GetSelection()->PrintSelf(os, indent.GetNextIndent());
  os << indent << "CellArrays:\n";
  this->Series->Cells.GetSelection()->PrintSelf(os, indent.GetNextIndent());
}
