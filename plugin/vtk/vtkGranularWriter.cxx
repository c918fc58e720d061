// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularWriter.h"

#include "private/guard.h"
#include "private/writer.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

using namespace vtkGranularPrivate;

using Pipeline = vtkStreamingDemandDrivenPipeline;

namespace
{
bool IsWhole(double time)
{
  return std::trunc(time) == time && std::abs(time) < 0x1p53;
}

/**
 * Processes that wrote other numbers of frames would wait for each other.
 */
void CheckTimes(granular::Communicator& ranks, const std::vector<double>& times)
{
  const std::string_view own(
    reinterpret_cast<const char*>(times.data()), times.size() * sizeof(double));
  const std::vector<std::string> all = ranks.all_gather(own);
  granular::do_together(ranks,
    [&]
    {
      if (all.front() != own)
      {
        throw granular::Error("expected the time steps of the first process, got others");
      }
    });
}
}

/**
 * What is written, as the pipeline makes it: frame by frame, and of each the piece of this process. The writer asks
 * for it itself, not by its own executive: that one would go on for ever where a frame cannot be made, hand
 * over the blocks of a composite one by one, and begin to count progress with each frame.
 */
class vtkGranularWriter::Input
{
public:
  explicit Input(vtkGranularWriter& writer)
    : Writer(writer)
  {
    this->Source = writer.GetInputAlgorithm(0, 0, this->Port);
    this->Source->UpdateInformation();
    this->Info = this->Source->GetOutputInformation(this->Port);
  }
  Input(const Input&) = delete;
  void operator=(const Input&) = delete;

  /**
   * Who asks next means the time that was shown, not the last that was written.
   */
  ~Input()
  {
    auto* pipeline = Pipeline::SafeDownCast(this->Source->GetExecutive());
    if (this->TimeBefore && pipeline)
    {
      this->Info->Set(Pipeline::UPDATE_TIME_STEP(), *this->TimeBefore);
      pipeline->PropagateUpdateExtent(this->Port);
    }
  }

  std::vector<double> GetTimes() const
  {
    const double* times = this->Info->Get(Pipeline::TIME_STEPS());
    return times ? std::vector<double>(times, times + this->Info->Length(Pipeline::TIME_STEPS()))
                 : std::vector<double>();
  }

  vtkDataObject* GetData() const { return this->Source->GetOutputDataObject(this->Port); }

  /**
   * The time of the data, as far as they know it.
   */
  std::optional<double> GetTime() const
  {
    vtkDataObject* data = this->GetData();
    vtkInformation* info = data ? data->GetInformation() : nullptr;
    return info && info->Has(vtkDataObject::DATA_TIME_STEP())
      ? std::optional(info->Get(vtkDataObject::DATA_TIME_STEP()))
      : std::nullopt;
  }

  /**
   * Makes the data of a time, or of the one that is shown. False if that fails, on this process.
   */
  bool Update(double time)
  {
    if (!this->TimeBefore)
    {
      this->TimeBefore = this->GetShownTime().value_or(time);
    }
    this->Info->Set(Pipeline::UPDATE_TIME_STEP(), time);
    return this->Update();
  }

  bool Update()
  {
    vtkMultiProcessController* controller = this->Writer.GetController();
    vtkNew<vtkInformationVector> requests;
    requests->SetNumberOfInformationObjects(this->Port + 1);
    vtkInformation* request = requests->GetInformationObject(this->Port);
    request->Set(Pipeline::UPDATE_PIECE_NUMBER(), controller ? controller->GetLocalProcessId() : 0);
    request->Set(
      Pipeline::UPDATE_NUMBER_OF_PIECES(), controller ? controller->GetNumberOfProcesses() : 1);
    request->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), this->Writer.GetGhostLevel());
    return this->Source->Update(this->Port, requests) != 0;
  }

  /**
   * Throws where there are no data to write.
   */
  void Check(bool made) const
  {
    if (this->Info->Get(vtkAlgorithm::ABORTED()))
    {
      throw granular::Cancelled{};
    }
    if (!made || !this->GetData())
    {
      throw granular::Error(
        "the input could not be made, and nothing is written: see the messages before",
        { this->Writer.GetFileName() });
    }
  }

private:
  /**
   * The time that the nearest of those before was asked for: a filter that is new, as ParaView puts some before
   * writers, has not been asked yet.
   */
  std::optional<double> GetShownTime() const
  {
    vtkAlgorithm* algorithm = this->Source;
    for (int port = this->Port; algorithm;)
    {
      vtkInformation* info = algorithm->GetOutputInformation(port);
      if (info->Has(Pipeline::UPDATE_TIME_STEP()))
      {
        return info->Get(Pipeline::UPDATE_TIME_STEP());
      }
      const bool more =
        algorithm->GetNumberOfInputPorts() > 0 && algorithm->GetNumberOfInputConnections(0) > 0;
      algorithm = more ? algorithm->GetInputAlgorithm(0, 0, port) : nullptr;
    }
    return {};
  }

  vtkGranularWriter& Writer;
  vtkAlgorithm* Source = nullptr;
  int Port = 0;
  vtkInformation* Info = nullptr;
  std::optional<double> TimeBefore;
};

//------------------------------------------------------------------------------
// Of the processes the first one speaks.
void vtkGranularWriter::Internals::Tell(vtkGranularWriter* self)
{
  for (const granular::Notice& notice : std::exchange(this->Notices, {}))
  {
    this->Tell(self, granular::to_string(notice));
  }
}

//------------------------------------------------------------------------------
void vtkGranularWriter::Internals::Tell(vtkGranularWriter* self, const std::string& text)
{
  if (this->Told.insert(text).second && this->GetRanks().rank() == 0)
  {
    vtkWarningWithObjectMacro(self, << text);
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
  os << indent << "WriteTimeSteps: " << this->WriteTimeSteps << "\n";
  os << indent << "ParallelMode: " << this->ParallelMode << "\n";
  os << indent << "Threads: " << this->Threads << "\n";
  os << indent << "GhostLevel: " << this->GhostLevel << "\n";
  os << indent << "Controller: " << this->GetController() << "\n";
  os << indent << "Written: " << this->Written << "\n";
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
int vtkGranularWriter::Write()
{
  Internals& shared = *this->Shared;
  this->Written = false;
  shared.Told.clear();
  shared.Notices.clear();
  this->SetAbortOutput(false);
  this->InvokeEvent(vtkCommand::StartEvent);
  this->UpdateProgress(0);
  const Outcome outcome =
    Guard(this, this->GetExecutive()->GetOutputInformation(), [&] { this->WriteFrames(); });
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
  Input input(*this);
  const std::vector<double> times = this->WriteTimeSteps ? input.GetTimes() : std::vector<double>();
  CheckTimes(ranks, times);
  shared.File = this->OpenFile(shared);
  AlgorithmProgress progress(this);
  granular::PartialProgress part(progress);
  const std::size_t frames = std::max<std::size_t>(1, times.size());
  for (std::size_t frame = 0; frame < frames; ++frame)
  {
    const bool made = times.empty() ? input.Update() : input.Update(times[frame]);
    granular::do_together(ranks, [&] { input.Check(made); });
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
