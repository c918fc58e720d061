// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularWriter.h"

#include "private/dump/input_frames.h"
#include "private/readers/series_reader.h"
#include "private/request/guard.h"
#include "private/request/print.h"
#include "private/writing/writer.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

using namespace vtkGranularPrivate;

using Pipeline = vtkStreamingDemandDrivenPipeline;

namespace
{
bool IsWhole(double time)
{
  return std::trunc(time) == time && std::abs(time) < 0x1p53;
}
}

//------------------------------------------------------------------------------
// Tells the user; the first process does that for all.
void vtkGranularWriter::Internals::Tell(vtkGranularWriter* self)
{
  for (const granular::Notice& notice : std::exchange(this->Notices, {}))
  {
    this->Tell(self, granular::to_string(notice), notice.topic);
  }
}

//------------------------------------------------------------------------------
void vtkGranularWriter::Internals::Tell(
  vtkGranularWriter* self, const std::string& text, const std::string& topic)
{
  if (this->Told.insert(topic.empty() ? text : topic).second && this->GetRanks().rank() == 0)
  {
    vtkWarningWithObjectMacro(self, << text);
  }
}

//------------------------------------------------------------------------------
granular::WriteOptions vtkGranularWriter::Internals::MakeOptions(const vtkGranularWriter* self)
{
  return { self->ParallelMode == MPI_IO ? granular::ParallelMode::MpiIo
                                        : granular::ParallelMode::Gather,
    vtkGranularPrivate::ChooseThreads(self->Threads, this->GetRanks()),
    static_cast<granular::Durability>(self->Durable), &this->Inputs };
}

//------------------------------------------------------------------------------
void vtkGranularWriter::Internals::FindInputs(vtkGranularWriter* self)
{
  this->Inputs = {};
  std::vector<vtkAlgorithm*> upstream = { self };
  for (std::size_t next = 0; next < upstream.size(); ++next)
  {
    vtkAlgorithm* algorithm = upstream[next];
    if (auto* reader = vtkGranularSeriesReader::SafeDownCast(algorithm))
    {
      this->Inputs.add(reader->Series->Run.index());
    }
    for (int port = 0; port < algorithm->GetNumberOfInputPorts(); ++port)
    {
      for (int input = 0; input < algorithm->GetNumberOfInputConnections(port); ++input)
      {
        vtkAlgorithm* before = algorithm->GetInputAlgorithm(port, input);
        if (std::find(upstream.begin(), upstream.end(), before) == upstream.end())
        {
          upstream.push_back(before);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
vtkGranularWriter::vtkGranularWriter()
  : Shared(std::make_unique<Internals>())
{
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
  os << indent << "Controller: " << this->GetController() << "\n";
  PrintProperties(os, indent, "WriteTimeSteps, ParallelMode, Durable, Threads, GhostLevel, Written",
    this->WriteTimeSteps, this->ParallelMode, this->Durable, this->Threads, this->GhostLevel,
    this->Written);
}

//------------------------------------------------------------------------------
// Each takes what it can of any input, and says of others what it expects.
int vtkGranularWriter::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

//------------------------------------------------------------------------------
void vtkGranularWriter::SetChoice(
  const char* name, int& property, int choice, std::initializer_list<const char*> choices)
{
  if (choice < 0 || choice >= static_cast<int>(choices.size()))
  {
    std::string all;
    for (const char* const& each : choices)
    {
      all +=
        (all.empty() ? "" : " or ") + std::to_string(&each - choices.begin()) + " (" + each + ")";
    }
    vtkErrorMacro("expected " << name << " " << all << ", got " << choice);
  }
  else if (property != choice)
  {
    property = choice;
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
  if (this->Shared->Ranks.SetController(controller))
  {
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkMultiProcessController* vtkGranularWriter::GetController()
{
  return this->Shared->Ranks.GetController();
}

//------------------------------------------------------------------------------
const char* vtkGranularWriter::GetErrorMessage()
{
  return this->Shared->Ranks.GetMessage().c_str();
}

//------------------------------------------------------------------------------
int vtkGranularWriter::Write()
{
  Internals& shared = *this->Shared;
  this->Written = false;
  shared.Told.clear();
  shared.Notices.clear();
  shared.Ranks.Forget(this);
  MarkStopped(this, false);
  this->InvokeEvent(vtkCommand::StartEvent);
  this->UpdateProgress(0);
  const Outcome outcome = Guard(
    this, shared.Ranks, this->GetExecutive()->GetOutputInformation(), [&] { this->WriteFrames(); });
  shared.Tell(this);
  shared.File.reset(); // what is not finished leaves nothing
  this->Written = outcome == Outcome::Done;
  this->SetAbortExecute(0); // holds for one file
  if (this->Written)
  {
    this->UpdateProgress(1);
  }
  this->InvokeEvent(vtkCommand::EndEvent);
  return this->Written ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkGranularWriter::WriteFrames()
{
  Internals& shared = *this->Shared;
  if (this->GetNumberOfInputConnections(0) == 0)
  {
    throw granular::Error("no input: expected points to write");
  }
  if (!this->FileName || !*this->FileName)
  {
    throw granular::IoError("no file to write: set FileName first");
  }
  granular::Communicator& ranks = shared.GetRanks();
  vtkMultiProcessController* controller = this->GetController();
  InputFrames input(this,
    { controller ? controller->GetLocalProcessId() : 0,
      controller ? controller->GetNumberOfProcesses() : 1, this->GhostLevel });
  const std::vector<double> times = this->WriteTimeSteps ? input.GetTimes() : std::vector<double>();
  CheckTimes(times, ranks);
  shared.FindInputs(this);
  shared.File = this->OpenFile(shared);
  AlgorithmProgress progress(this);
  granular::PartialProgress part(progress);
  const std::size_t frames = std::max<std::size_t>(1, times.size());
  for (std::size_t frame = 0; frame < frames; ++frame)
  {
    input.Update(times.empty() ? std::nullopt : std::optional(times[frame]), ranks,
      ", and nothing is written", { this->FileName });
    const auto all = static_cast<double>(frames);
    const auto first = static_cast<double>(frame);
    part.set_part(first / all, (first + 1) / all);
    FrameTime time{ input.GetTime(), static_cast<vtkTypeInt64>(frame), {} };
    if (times.empty() ? time.Time && IsWhole(*time.Time)
                      : std::all_of(times.begin(), times.end(), IsWhole))
    {
      time.Step = static_cast<vtkTypeInt64>(times.empty() ? *time.Time : times[frame]);
    }
    shared.File->Write(input.GetData(), time, shared.Notices, part);
    shared.Tell(this);
  }
  shared.File->Finish();
}
