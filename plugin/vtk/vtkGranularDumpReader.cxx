// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDumpReader.h"

#include "private/arrays/array_choice.h"
#include "private/arrays/arrays.h"
#include "private/dump/dump_output.h"
#include "private/dump/reader_frames.h"
#include "private/request/guard.h"
#include "private/request/piece_request.h"
#include "private/request/series_reader.h"

#include "granular/common/words.h"
#include "granular/dump/formats/dump_files.h"
#include "granular/dump/read/dump_reader.h"

#include "vtkCommand.h"
#include "vtkDataArraySelection.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDumpReader);

//------------------------------------------------------------------------------
struct vtkGranularDumpReader::Internals
{
  using Self = vtkGranularDumpReader;
  using Shown = vtkGranularSeriesReader::Internals::Shown;

  std::string ColumnNames; ///< as they were given
  ArrayChoice Arrays;

  VertexCache Vertices; ///< of the frame before

  void UpdateSelection(const granular::RunIndex& index);
  granular::DumpRequest MakeRequest(Self* self);
  granular::DumpRequest MakeRequest(Self* self, vtkInformation* output);
  void FillOutputs(Self* self, vtkInformationVector* outputs, const granular::DumpRequest& request,
    granular::DumpFrame& frame, Shown& shown);
  void Show(Self* self, vtkInformationVector* outputs, Shown& shown);
};

//------------------------------------------------------------------------------
// The arrays of all frames, in the order in which they occur.
void vtkGranularDumpReader::Internals::UpdateSelection(const granular::RunIndex& index)
{
  std::set<const granular::FrameKind*> seen;
  this->Arrays.Begin();
  for (std::size_t frame = 0; frame < index.size(); ++frame)
  {
    const granular::FrameKind* kind = index.first_piece(frame).entry.kind.get();
    if (!seen.insert(kind).second)
    {
      continue;
    }
    for (const granular::ArrayInfo& array : kind->schema.arrays())
    {
      this->Arrays.Add(array.name, !array.position_form);
    }
  }
  this->Arrays.End();
}

//------------------------------------------------------------------------------
granular::DumpRequest vtkGranularDumpReader::Internals::MakeRequest(Self* self)
{
  granular::DumpRequest request;
  request.coordinates = static_cast<granular::Coordinates>(self->Coordinates);
  request.single_precision = self->PointPrecision == SINGLE_PRECISION;
  std::copy_n(self->PointOrigin, 3, request.point_origin.begin());
  if (!std::ranges::all_of(
        request.point_origin, [](double coordinate) { return std::isfinite(coordinate); }))
  {
    throw granular::LimitError("PointOrigin must be finite");
  }
  request.sort_by_id = self->SortById;
  request.stride = self->Stride;
  std::copy_n(self->RegionOfInterest, 6, request.region.begin());
  // a copy: the frame may be decoded while the selection changes
  request.wanted = [names = this->Arrays.GetWanted()](const granular::ArrayInfo& array)
  { return names.count(array.name) != 0; };
  request.threads = ChooseThreads(self->Threads, self->Series->GetRanks());
  request.pool = self->Series->Pool;
  return request;
}

//------------------------------------------------------------------------------
granular::DumpRequest vtkGranularDumpReader::Internals::MakeRequest(
  Self* self, vtkInformation* output)
{
  granular::DumpRequest request = this->MakeRequest(self);
  const PieceRequest wanted = PieceRequest::Of(output);
  request.piece = wanted.Piece;
  request.pieces = wanted.Pieces;
  request.ranges = true; // whoever shows an array asks for it
  return request;
}

//------------------------------------------------------------------------------
void vtkGranularDumpReader::Internals::FillOutputs(Self* self, vtkInformationVector* outputs,
  const granular::DumpRequest& request, granular::DumpFrame& frame, Shown& shown)
{
  const VertexCells cells[] = { VertexCells::None, VertexCells::One, VertexCells::OnePerPoint };
  FillParticles(vtkPolyData::GetData(outputs, 0), frame, request.single_precision,
    cells[self->Vertices], this->Vertices, self->Series->Pool);
  auto* box = vtkUnstructuredGrid::GetData(outputs, 1);
  if (request.piece == 0 &&
    !FillBox(box, frame.header.box, frame.coordinates, request.point_origin))
  {
    shown.Notices.push_back({ shown.Where, "the box is not finite and not shown" });
  }
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkFieldData* about = vtkDataObject::GetData(outputs, port)->GetFieldData();
    FillFieldData(about, frame, request.point_origin);
    FillLeftOut(about, request);
  }
}

//------------------------------------------------------------------------------
// The ranks exchange rows, if they read together.
void vtkGranularDumpReader::Internals::Show(Self* self, vtkInformationVector* outputs, Shown& shown)
{
  granular::Communicator& ranks = self->Series->GetRanks();
  self->Series->StartFrame(shown.Notices);
  const granular::DumpRequest request = this->MakeRequest(self, shown.Port);
  this->Arrays.CheckNames(shown.Where.path, shown.Notices);
  shown.Together = AskTogether(ranks, { request.piece, request.pieces }, this->Arrays.GetWanted(),
    [&](granular::ArchiveWriter& form)
    {
      form.number(shown.Number);
      form.number(request.coordinates);
      form.number(request.single_precision);
      form.number(request.point_origin);
      form.number(request.sort_by_id);
      form.number(request.stride);
      form.number(request.region);
    });
  granular::SerialCommunicator alone;
  granular::DumpFrame frame = granular::read_dump(
    shown.Pieces, request, shown.Together ? ranks : alone, shown.Notices, shown.Progress);
  this->FillOutputs(self, outputs, request, frame, shown);
}

//------------------------------------------------------------------------------
std::optional<ReaderFrames> ReaderFrames::Find(vtkAlgorithm* consumer)
{
  int port = 0;
  vtkAlgorithm* algorithm = consumer->GetInputAlgorithm(0, 0, port);
  while (algorithm && port == 0 && algorithm->IsA("vtkPVPostFilter"))
  {
    algorithm = algorithm->GetInputAlgorithm(0, 0, port);
  }
  auto* reader = vtkGranularDumpReader::SafeDownCast(algorithm);
  if (!reader || port != 0 || !reader->Series->Valid || reader->Series->Index.size() == 0)
  {
    return {};
  }
  return ReaderFrames{ &reader->Series->Index, reader->Internal->MakeRequest(reader) };
}

//------------------------------------------------------------------------------
vtkGranularDumpReader::vtkGranularDumpReader()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(2);
  this->Series->Format = &granular::dump_format();
  this->Internal->Arrays.GetSelection()->AddObserver(
    vtkCommand::ModifiedEvent, this, &vtkGranularDumpReader::Modified);
}

//------------------------------------------------------------------------------
vtkGranularDumpReader::~vtkGranularDumpReader() = default;

//------------------------------------------------------------------------------
vtkPolyData* vtkGranularDumpReader::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

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
  return this->Internal->Arrays.GetSelection();
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
  return this->Series->Run(this, request, outputVector,
    [&](auto& shown) { this->Internal->Show(this, outputVector, shown); });
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
  this->Internal->Arrays.GetSelection()->PrintSelf(os, indent.GetNextIndent());
}
