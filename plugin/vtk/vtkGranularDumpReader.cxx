// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDumpReader.h"

#include "private/dump_output.h"
#include "private/guard.h"

#include "granular/base/byte_source.h"
#include "granular/dump/dump_reader.h"
#include "granular/dump/frame_index.h"
#include "granular/dump/text_dump.h"

#include "vtkCommand.h"
#include "vtkDataArraySelection.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDumpReader);

//------------------------------------------------------------------------------
struct vtkGranularDumpReader::Internals
{
  using Self = vtkGranularDumpReader;

  std::vector<std::string> FileNames;
  vtkNew<vtkDataArraySelection> PointArrays;
  granular::FrameIndex Index;
  std::vector<std::string> IndexedNames; ///< what Index was made from; empty: it is not valid
  bool Stale = false;                    ///< the files are to be looked at again
  bool Cancelled = false;                ///< the last request was
  std::set<std::string> Told;            ///< notices the user has had
  std::set<std::string> ArrayNames;      ///< of all frames

  void UpdateIndex(Self* self);
  void UpdateSelection();
  void CheckSelection(const std::string& path, granular::Notices& notices);
  void Tell(Self* self, const granular::Notices& notices, bool ofFrames);
  granular::DumpRequest MakeRequest(Self* self);
  const granular::FrameEntry& FindFrame(
    Self* self, vtkInformation* request, vtkInformationVector* outputs, double& time);
  void FillOutputs(Self* self, vtkInformation* request, vtkInformationVector* outputs);
};

//------------------------------------------------------------------------------
// Brings the index up to the files, if they are to be looked at at all. Throws, and leaves the index
// invalid, if there is nothing to show.
void vtkGranularDumpReader::Internals::UpdateIndex(Self* self)
{
  if (this->FileNames.empty())
  {
    throw granular::IoError("no file to read: set FileNames first");
  }
  if (!this->Stale && this->IndexedNames == this->FileNames)
  {
    return;
  }
  if (this->IndexedNames != this->FileNames)
  {
    this->Told.clear();
  }
  this->IndexedNames.clear();
  granular::Notices notices;
  AlgorithmProgress progress(self);
  this->Index.update(this->FileNames, notices, progress);
  this->IndexedNames = this->FileNames;
  this->Stale = false;
  this->UpdateSelection();
  this->Tell(self, notices, true);
}

//------------------------------------------------------------------------------
// The arrays of all frames, in the order in which they occur; what was chosen before stays.
void vtkGranularDumpReader::Internals::UpdateSelection()
{
  std::set<const granular::ColumnSchema*> seen;
  this->ArrayNames.clear();
  for (const granular::FrameEntry& entry : this->Index.frames())
  {
    if (!seen.insert(entry.schema.get()).second)
    {
      continue;
    }
    for (const granular::ArrayInfo& array : entry.schema->arrays())
    {
      this->ArrayNames.insert(array.name);
      this->PointArrays->AddArray(array.name.c_str(), !array.position_form);
    }
  }
  for (int i = this->PointArrays->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (this->ArrayNames.count(this->PointArrays->GetArrayName(i)) == 0)
    {
      this->PointArrays->RemoveArrayByIndex(i);
    }
  }
}

//------------------------------------------------------------------------------
// A name that is asked for and in no frame is a slip of the pen: without a word, a column is missing.
void vtkGranularDumpReader::Internals::CheckSelection(
  const std::string& path, granular::Notices& notices)
{
  for (int i = 0; i < this->PointArrays->GetNumberOfArrays(); ++i)
  {
    const std::string name = this->PointArrays->GetArrayName(i);
    if (this->PointArrays->GetArraySetting(i) != 0 && this->ArrayNames.count(name) == 0)
    {
      notices.push_back({ { path, 0, -1, {} }, "no frame has the array '" + name + "' asked for" });
    }
  }
}

//------------------------------------------------------------------------------
// One warning a file, and each notice once, for whichever frame it came first; not too many.
void vtkGranularDumpReader::Internals::Tell(
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
    const std::string what = ofFrames || about.empty() ? notice.text : "";
    if (this->Told.insert(path + "\n" + about + "\n" + what).second && ++counts[path] <= most)
    {
      std::string& joined = texts[path];
      joined += (joined.empty() ? "" : "\n") + granular::to_string(notice);
    }
  }
  for (const auto& [path, text] : texts)
  {
    const int more = counts[path] - most;
    vtkWarningWithObjectMacro(
      self, << text << (more > 0 ? "\nand " + std::to_string(more) + " more" : ""));
  }
}

//------------------------------------------------------------------------------
granular::DumpRequest vtkGranularDumpReader::Internals::MakeRequest(Self* self)
{
  granular::DumpRequest request;
  request.coordinates = static_cast<granular::Coordinates>(self->Coordinates);
  request.single_precision = self->PointPrecision == SINGLE_PRECISION;
  std::copy_n(self->PointOrigin, 3, request.point_origin.begin());
  request.sort_by_id = self->SortById;
  request.stride = self->Stride;
  std::copy_n(self->RegionOfInterest, 6, request.region.begin());
  request.wanted = [this](const granular::ArrayInfo& array)
  { return this->PointArrays->ArrayIsEnabled(array.name.c_str()) != 0; };
  return request;
}

//------------------------------------------------------------------------------
// The frame that the port which is asked for shows, and its time.
const granular::FrameEntry& vtkGranularDumpReader::Internals::FindFrame(
  Self* self, vtkInformation* request, vtkInformationVector* outputs, double& time)
{
  const std::vector<double> times = this->Index.times(self->TimestepSize);
  const int port = request->Has(vtkDemandDrivenPipeline::FROM_OUTPUT_PORT())
    ? request->Get(vtkDemandDrivenPipeline::FROM_OUTPUT_PORT())
    : 0;
  vtkInformation* info = outputs->GetInformationObject(port > 0 ? port : 0);
  std::size_t frame = 0;
  if (info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()))
  {
    frame = granular::FrameIndex::find(
      times, info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP()));
  }
  time = times[frame];
  return this->Index.frames()[frame];
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::Internals::FillOutputs(
  Self* self, vtkInformation* request, vtkInformationVector* outputs)
{
  double time = 0;
  const granular::FrameEntry& entry = this->FindFrame(self, request, outputs, time);
  const std::string& path = this->Index.files()[entry.file];
  const granular::DumpRequest wanted = this->MakeRequest(self);
  for (double coordinate : wanted.point_origin)
  {
    if (!std::isfinite(coordinate))
    {
      throw granular::LimitError("PointOrigin must be finite");
    }
  }
  granular::Notices notices;
  this->CheckSelection(path, notices);
  AlgorithmProgress progress(self);
  progress.step(0);
  granular::DumpFrame frame = granular::read_dump(path, entry, wanted, notices, progress);
  progress.step(1);

  const VertexCells cells[] = { VertexCells::None, VertexCells::One, VertexCells::OnePerPoint };
  FillParticles(vtkPolyData::GetData(outputs, 0), frame, *entry.schema, wanted.single_precision,
    cells[self->Vertices]);
  if (!FillBox(vtkUnstructuredGrid::GetData(outputs, 1), entry.header.box, frame.coordinates,
        wanted.point_origin))
  {
    notices.push_back({ { path, entry.line, -1, {} }, "the box is not finite and not shown" });
  }
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject* output = vtkDataObject::GetData(outputs, port);
    FillFieldData(output->GetFieldData(), entry, frame.coordinates, wanted.point_origin);
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  }
  this->Tell(self, notices, false);
}

//------------------------------------------------------------------------------
vtkGranularDumpReader::vtkGranularDumpReader()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(2);
  this->Internal->PointArrays->AddObserver(
    vtkCommand::ModifiedEvent, this, &vtkGranularDumpReader::Modified);
}

//------------------------------------------------------------------------------
vtkGranularDumpReader::~vtkGranularDumpReader() = default;

//------------------------------------------------------------------------------
void vtkGranularDumpReader::AddFileName(const char* fileName)
{
  if (fileName && *fileName)
  {
    this->Internal->FileNames.emplace_back(fileName);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::ClearFileNames()
{
  if (!this->Internal->FileNames.empty())
  {
    this->Internal->FileNames.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkGranularDumpReader::GetNumberOfFileNames()
{
  return static_cast<int>(this->Internal->FileNames.size());
}

//------------------------------------------------------------------------------
const char* vtkGranularDumpReader::GetFileName(int index)
{
  return index >= 0 && index < this->GetNumberOfFileNames()
    ? this->Internal->FileNames[index].c_str()
    : nullptr;
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::Refresh()
{
  this->Internal->Stale = true;
  this->Modified();
}

//------------------------------------------------------------------------------
int vtkGranularDumpReader::CanReadFile(const char* fileName)
{
  // a header of ordinary length is there many times over, and more is not read for a question
  constexpr std::size_t firstBytes = 65536;
  try
  {
    const auto source = granular::open_file(fileName ? fileName : "");
    std::string bytes(firstBytes, '\0');
    bytes.resize(source->read(0, bytes.data(), bytes.size()));
    return granular::is_text_dump(bytes) ? 1 : 0;
  }
  catch (const std::exception&)
  {
    return 0;
  }
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::SetTimestepSize(double size)
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
void vtkGranularDumpReader::SetStride(vtkTypeInt64 stride)
{
  if (stride < 1)
  {
    vtkErrorMacro("Stride must be at least 1, got " << stride);
    return;
  }
  if (this->Stride != stride)
  {
    this->Stride = stride;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkDataArraySelection* vtkGranularDumpReader::GetPointDataArraySelection()
{
  return this->Internal->PointArrays;
}

//------------------------------------------------------------------------------
int vtkGranularDumpReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPolyData" : "vtkUnstructuredGrid");
  return 1;
}

//------------------------------------------------------------------------------
// The first call of every update. A request to abort holds for one update, and observers of progress
// may make it again while the pipeline leaves the aborted one: it is forgotten here. What was
// aborted may have been the look at the files, so all is done again.
int vtkGranularDumpReader::ComputePipelineMTime(vtkInformation* request,
  vtkInformationVector** inputVector, vtkInformationVector* outputVector, int requestFromOutputPort,
  vtkMTimeType* mtime)
{
  if (this->Internal->Cancelled)
  {
    this->Internal->Cancelled = false;
    this->SetAbortExecute(0);
    this->SetAbortOutput(false);
    this->Modified();
  }
  return this->Superclass::ComputePipelineMTime(
    request, inputVector, outputVector, requestFromOutputPort, mtime);
}

//------------------------------------------------------------------------------
int vtkGranularDumpReader::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  std::vector<double> times;
  const Outcome outcome = Guard(this, outputVector,
    [&]
    {
      this->Internal->UpdateIndex(this);
      times = this->Internal->Index.times(this->TimestepSize);
    });
  this->Internal->Cancelled = outcome == Outcome::Cancelled;
  for (int port = 0; port < outputVector->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* info = outputVector->GetInformationObject(port);
    info->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
    info->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
    if (!times.empty())
    {
      const double range[] = { times.front(), times.back() };
      info->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(),
        static_cast<int>(times.size()));
      info->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
    }
  }
  return outcome != Outcome::Failed;
}

//------------------------------------------------------------------------------
int vtkGranularDumpReader::RequestData(vtkInformation* request,
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  const Outcome outcome = Guard(this, outputVector,
    [&]
    {
      if (this->Internal->Cancelled)
      {
        throw granular::Cancelled();
      }
      // valid already, but for a pipeline that goes on after RequestInformation failed
      this->Internal->UpdateIndex(this);
      this->Internal->FillOutputs(this, request, outputVector);
    });
  this->Internal->Cancelled = outcome == Outcome::Cancelled;
  return outcome != Outcome::Failed;
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileNames: " << this->GetNumberOfFileNames() << "\n";
  for (const std::string& name : this->Internal->FileNames)
  {
    os << indent.GetNextIndent() << name << "\n";
  }
  os << indent << "Coordinates: " << this->Coordinates << "\n";
  os << indent << "PointPrecision: " << this->PointPrecision << "\n";
  os << indent << "PointOrigin: " << this->PointOrigin[0] << " " << this->PointOrigin[1] << " "
     << this->PointOrigin[2] << "\n";
  os << indent << "TimestepSize: " << this->TimestepSize << "\n";
  os << indent << "SortById: " << (this->SortById ? "On" : "Off") << "\n";
  os << indent << "Vertices: " << this->Vertices << "\n";
  os << indent << "Stride: " << this->Stride << "\n";
  os << indent << "RegionOfInterest:";
  for (double bound : this->RegionOfInterest)
  {
    os << " " << bound;
  }
  os << "\n" << indent << "PointArrays:\n";
  this->Internal->PointArrays->PrintSelf(os, indent.GetNextIndent());
}
