// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDumpReader.h"

#include "private/dump_output.h"
#include "private/guard.h"
#include "private/series_reader.h"

#include "granular/base/words.h"
#include "granular/dump/dump_reader.h"
#include "granular/dump/file_index.h"

#include "vtkCommand.h"
#include "vtkDataArraySelection.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDumpReader);

//------------------------------------------------------------------------------
struct vtkGranularDumpReader::Internals
{
  using Self = vtkGranularDumpReader;

  std::string ColumnNames; ///< as they were given
  vtkNew<vtkDataArraySelection> PointArrays;
  std::set<std::string> ArrayNames; ///< of all frames

  void UpdateSelection(const granular::FrameIndex& index);
  void CheckSelection(const std::string& path, granular::Notices& notices);
  granular::DumpRequest MakeRequest(Self* self);
  void FillOutputs(Self* self, vtkInformation* request, vtkInformationVector* outputs);
};

//------------------------------------------------------------------------------
// The arrays of all frames, in the order in which they occur; what was chosen before stays.
void vtkGranularDumpReader::Internals::UpdateSelection(const granular::FrameIndex& index)
{
  std::set<const granular::FrameKind*> seen;
  this->ArrayNames.clear();
  for (std::size_t frame = 0; frame < index.size(); ++frame)
  {
    const granular::FrameKind* kind = index.first_piece(frame).entry.kind.get();
    if (!seen.insert(kind).second)
    {
      continue;
    }
    for (const granular::ArrayInfo& array : kind->schema.arrays())
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
void vtkGranularDumpReader::Internals::FillOutputs(
  Self* self, vtkInformation* request, vtkInformationVector* outputs)
{
  double time = 0;
  const std::size_t number = self->Series->FindFrame(self, request, outputs, time);
  const std::vector<granular::FramePiece> pieces = self->Series->Index.pieces(number);
  const std::string& path = pieces.front().file.path;
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
  granular::DumpFrame frame = granular::read_dump(pieces, wanted, notices, progress);
  progress.step(1);

  const VertexCells cells[] = { VertexCells::None, VertexCells::One, VertexCells::OnePerPoint };
  FillParticles(
    vtkPolyData::GetData(outputs, 0), frame, wanted.single_precision, cells[self->Vertices]);
  if (!FillBox(vtkUnstructuredGrid::GetData(outputs, 1), frame.header.box, frame.coordinates,
        wanted.point_origin))
  {
    notices.push_back(
      { granular::where_of(path, pieces.front().entry), "the box is not finite and not shown" });
  }
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject* output = vtkDataObject::GetData(outputs, port);
    FillFieldData(output->GetFieldData(), frame, wanted.point_origin);
    output->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  }
  self->Series->Tell(self, notices, false);
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
void vtkGranularDumpReader::FramesChanged()
{
  this->Internal->UpdateSelection(this->Series->Index);
}

//------------------------------------------------------------------------------
int vtkGranularDumpReader::CanReadFile(const char* fileName)
{
  return granular::is_dump_file(fileName ? fileName : "") ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::SetColumnNames(const char* names)
{
  const std::string wanted = names ? names : "";
  if (this->Internal->ColumnNames != wanted)
  {
    std::string spaced = wanted; // no column has a comma in its name
    std::replace(spaced.begin(), spaced.end(), ',', ' ');
    const std::vector<std::string_view> words = granular::split_words(spaced);
    this->Internal->ColumnNames = wanted;
    this->Series->ColumnNames.assign(words.begin(), words.end());
    this->Refresh();
  }
}

//------------------------------------------------------------------------------
const char* vtkGranularDumpReader::GetColumnNames()
{
  return this->Internal->ColumnNames.c_str();
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
int vtkGranularDumpReader::RequestData(vtkInformation* request,
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  const Outcome outcome = Guard(this, outputVector,
    [&]
    {
      if (this->Series->Cancelled)
      {
        throw granular::Cancelled();
      }
      // valid already, but for a pipeline that goes on after RequestInformation failed
      this->Series->Update(this);
      this->Internal->FillOutputs(this, request, outputVector);
    });
  this->Series->Cancelled = outcome == Outcome::Cancelled;
  return outcome != Outcome::Failed;
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ColumnNames: " << this->Internal->ColumnNames << "\n";
  os << indent << "Coordinates: " << this->Coordinates << "\n";
  os << indent << "PointPrecision: " << this->PointPrecision << "\n";
  os << indent << "PointOrigin: " << this->PointOrigin[0] << " " << this->PointOrigin[1] << " "
     << this->PointOrigin[2] << "\n";
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
