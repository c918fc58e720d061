// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularSeriesReader.h"

#include "private/arrays/pool.h"
#include "private/request/guard.h"
#include "private/request/kept_pieces.h"
#include "private/request/series_reader.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

using namespace vtkGranularPrivate;

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::Update(Self* self)
{
  if (this->FileNames.empty())
  {
    throw granular::IoError("no file to read: set FileNames first");
  }
  if (this->Valid && !this->Stale && this->IndexedNames == this->FileNames)
  {
    return;
  }
  granular::Communicator& ranks = this->GetRanks();
  this->Valid = false;
  granular::IndexOptions options;
  self->ForgetFrames();
  if (this->IndexedNames != this->FileNames)
  {
    this->Told.clear();
    this->IndexedNames = this->FileNames;
  }
  options.format = this->Format;
  options.column_names = this->ColumnNames;
  options.repeated_steps = static_cast<granular::RepeatedSteps>(self->RepeatedSteps);
  options.threads = ChooseThreads(self->Threads, ranks);
  granular::Notices notices;
  AlgorithmProgress progress(self);
  granular::update_run_index(this->Index, ranks, this->FileNames, options, notices, progress);
  granular::do_together(ranks,
    [&]
    {
      self->FramesChanged();
      if (ranks.rank() == 0)
      {
        this->Tell(self, notices, true);
      }
    });
  this->Valid = true;
  this->Stale = false;
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::Tell(
  Self* self, const granular::Notices& notices, bool ofFrames)
{
  constexpr int most = 10;
  std::map<std::string, std::string> texts;
  std::map<std::string, int> counts;
  for (const granular::Notice& notice : notices)
  {
    const std::string& path = notice.where.path;
    // what is said of a column, or of all rows, holds for the next frames too; what is said of
    // frames is new for each
    const std::string about = ofFrames ? std::to_string(notice.where.line) : notice.where.column;
    const std::string what = !notice.topic.empty() ? notice.topic
      : ofFrames || about.empty()                  ? notice.text
                                                   : "";
    if (this->Told.insert(path + "\n" + about + "\n" + what).second && ++counts[path] <= most)
    {
      std::string& joined = texts[path];
      joined += (joined.empty() ? "" : "\n") + granular::to_string(notice);
    }
  }
  int files = 0;
  for (const auto& [path, text] : texts)
  {
    if (++files > most)
    {
      vtkWarningWithObjectMacro(
        self, << "there is more to say of " << texts.size() - most << " more files");
      break;
    }
    const int more = counts[path] - most;
    vtkWarningWithObjectMacro(
      self, << text << (more > 0 ? "\nand " + std::to_string(more) + " more" : ""));
  }
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::Internals::StartFrame(granular::Notices& notices)
{
  if (!this->PoolMade)
  {
    this->Pool = MakePool(notices);
    this->PoolMade = true;
  }
  if (this->Pool)
  {
    this->Pool->next_frame();
  }
}

//------------------------------------------------------------------------------
int vtkGranularSeriesReader::Internals::Run(Self* self, vtkInformation* request,
  vtkInformationVector* outputs, const std::function<void(Shown&)>& show)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const Outcome outcome = Guard(self, this->Ranks, outputs,
    [&]
    {
      if (this->Ranks.IsCancelled())
      {
        throw granular::Cancelled();
      }
      // valid already, but for a pipeline that goes on after RequestInformation failed
      this->Update(self);
      AlgorithmProgress own(self);
      granular::SharedProgress together(own, this->GetRanks());
      granular::PartialProgress progress(together);
      progress.step(0);
      Shown shown{ .Progress = progress };
      const int port =
        request->Has(Pipeline::FROM_OUTPUT_PORT()) ? request->Get(Pipeline::FROM_OUTPUT_PORT()) : 0;
      shown.Port = outputs->GetInformationObject(std::max(port, 0));
      const std::vector<double> times = this->Index.times(self->TimestepSize);
      if (shown.Port->Has(Pipeline::UPDATE_TIME_STEP()))
      {
        shown.Number =
          granular::RunIndex::find(times, shown.Port->Get(Pipeline::UPDATE_TIME_STEP()));
      }
      shown.Time = times[shown.Number];
      shown.Pieces = this->Index.pieces(shown.Number);
      shown.Where = granular::where_of(shown.Pieces.front());
      show(shown);
      for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
      {
        vtkDataObject::GetData(outputs, i)
          ->GetInformation()
          ->Set(vtkDataObject::DATA_TIME_STEP(), shown.Time);
      }
      if (this->GetRanks().rank() == 0 || !shown.Together)
      {
        this->Tell(self, shown.Notices, false);
      }
      progress.set_part(1, 1);
      progress.step(1);
    });
  if (outcome != Outcome::Done)
  {
    self->ForgetFrames();
  }
  return this->Ranks.EndRequest(self, outcome);
}

//------------------------------------------------------------------------------
vtkGranularSeriesReader::vtkGranularSeriesReader()
  : Series(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(0);
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
void vtkGranularSeriesReader::Refresh()
{
  this->Series->Stale = true;
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::SetRepeatedSteps(int repeated)
{
  repeated = std::clamp(repeated, static_cast<int>(AUTO), static_cast<int>(LAST));
  if (this->RepeatedSteps != repeated)
  {
    this->RepeatedSteps = repeated;
    this->Refresh();
  }
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::SetThreads(int threads)
{
  if (threads < 0)
  {
    vtkErrorMacro("Threads must be at least 0, got " << threads);
    return;
  }
  this->Threads = threads; // changes no result: nothing is to be read again
}

//------------------------------------------------------------------------------
void vtkGranularSeriesReader::SetController(vtkMultiProcessController* controller)
{
  if (this->Series->Ranks.SetController(controller))
  {
    this->ForgetFrames();
    this->Series->Index = {}; // the new ranks have none, or others
    this->Series->Valid = false;
    this->Refresh();
  }
}

//------------------------------------------------------------------------------
vtkMultiProcessController* vtkGranularSeriesReader::GetController()
{
  return this->Series->Ranks.GetController();
}

//------------------------------------------------------------------------------
const char* vtkGranularSeriesReader::GetErrorMessage()
{
  return this->Series->Ranks.GetMessage().c_str();
}

//------------------------------------------------------------------------------
// Modifies nothing: else, asked on one rank of many, that rank alone would read again, and wait for ever.
void vtkGranularSeriesReader::SetAbortExecute(vtkTypeBool abort)
{
  this->AbortExecute = abort;
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
// The first call of every update. What was aborted may have been the look at the files, so all is done again.
// Exceptions must not pass the pipeline: where it cannot be told whether files changed, the update that
// follows says why.
int vtkGranularSeriesReader::ComputePipelineMTime(vtkInformation* request,
  vtkInformationVector** inputVector, vtkInformationVector* outputVector, int requestFromOutputPort,
  vtkMTimeType* mtime)
{
  this->Series->Ranks.BeginUpdate(this);
  if (this->RefreshOnUpdate)
  {
    bool changed = true;
    try
    {
      changed =
        !this->Series->Valid || granular::is_changed(this->Series->Index, this->Series->GetRanks());
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
void vtkGranularSeriesReader::InspectFrames(vtkInformationVector* vtkNotUsed(outputVector))
{
}

//------------------------------------------------------------------------------
int vtkGranularSeriesReader::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  const auto forEachPort = [&](const auto& tell)
  {
    for (int port = 0; port < outputVector->GetNumberOfInformationObjects(); ++port)
    {
      tell(outputVector->GetInformationObject(port));
    }
  };
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  const Outcome outcome = Guard(this, this->Series->Ranks, outputVector,
    [&]
    {
      forEachPort(
        [](vtkInformation* info)
        {
          info->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
          info->Remove(Pipeline::TIME_STEPS());
          info->Remove(Pipeline::TIME_RANGE());
        });
      this->Series->Update(this);
      granular::Notices notices;
      const std::vector<double> times = this->Series->Index.times(this->TimestepSize, notices);
      if (this->Series->GetRanks().rank() == 0)
      {
        this->Series->Tell(this, notices, true);
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
      this->InspectFrames(outputVector);
    });
  if (outcome != Outcome::Done)
  {
    this->ForgetFrames(); // what some ranks know of them others may not
  }
  return this->Series->Ranks.EndRequest(this, outcome);
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
  os << indent << "Threads: " << this->Threads << "\n";
  os << indent << "Controller: " << this->GetController() << "\n";
}
