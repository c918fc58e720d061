// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDataFileReader.h"

#include "private/arrays/array_choice.h"
#include "private/arrays/arrays.h"
#include "private/dump/dump_output.h"
#include "private/local/lines.h"
#include "private/request/look_together.h"
#include "private/request/piece_request.h"
#include "private/request/series_reader.h"

#include "granular/common/archive.h"
#include "granular/data_file/data_file.h"
#include "granular/data_file/read_data.h"

#include "vtkCommand.h"
#include "vtkDataArraySelection.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDataFileReader);

//------------------------------------------------------------------------------
struct vtkGranularDataFileReader::Internals
{
  using Self = vtkGranularDataFileReader;
  using Shown = vtkGranularSeriesReader::Internals::Shown;

  std::string AtomStyle;
  std::string Boundary;
  ArrayChoice Points;
  ArrayChoice Cells;
  bool Known = false;   ///< somebody has looked which arrays there are
  VertexCache Vertices; ///< of the frame before

  void Look(Self* self);
  granular::DataRequest MakeRequest(Self* self, vtkInformation* output) const;
  void FillOutputs(Self* self, vtkInformationVector* outputs, const granular::DataRequest& request,
    granular::DataFrame& frame, Shown& shown);
  void Show(Self* self, vtkInformationVector* outputs, Shown& shown);
};

//------------------------------------------------------------------------------
// Rank 0 looks, for all, at the first file and the last one. Collective.
void vtkGranularDataFileReader::Internals::Look(Self* self)
{
  if (this->Known)
  {
    return;
  }
  const auto look = [&](granular::ArchiveWriter& packer)
  {
    AlgorithmProgress progress(self);
    granular::Notices notices; // are given again where the frame is shown
    const granular::RunIndex& index = self->Series->Index;
    std::set<std::size_t> frames = { 0, index.size() - 1 };
    std::size_t count = frames.size();
    packer.number(count);
    for (const std::size_t frame : frames)
    {
      const granular::FramePiece piece = index.first_piece(frame);
      const auto source = granular::open_indexed(piece.file);
      granular::DataColumns columns =
        granular::find_data_columns(*granular::find_data_layout(piece.file, *source, progress),
          this->AtomStyle, piece.file.path, notices);
      granular::pass(packer, columns.particles);
      granular::pass(packer, columns.velocities);
      granular::pass(packer, columns.ellipsoids);
    }
  };
  const auto take = [&](granular::ArchiveReader& unpacker)
  {
    const auto offer = [](ArrayChoice& choice, const granular::ColumnSchema& schema)
    {
      for (const granular::ArrayInfo& array : schema.arrays())
      {
        choice.Add(array.name, !array.position_form);
      }
    };
    std::size_t count = 0;
    unpacker.number(count);
    this->Points.Begin();
    for (; count > 0; --count)
    {
      granular::DataColumns columns;
      granular::pass(unpacker, columns.particles);
      granular::pass(unpacker, columns.velocities);
      granular::pass(unpacker, columns.ellipsoids);
      offer(this->Points, granular::make_particle_schema(columns));
    }
    this->Points.End();
    this->Cells.Begin();
    offer(this->Cells, granular::make_data_bond_schema());
    this->Cells.End();
    this->Known = true;
  };
  LookTogether(self->Series->GetRanks(), look, take);
}

//------------------------------------------------------------------------------
granular::DataRequest vtkGranularDataFileReader::Internals::MakeRequest(
  Self* self, vtkInformation* output) const
{
  granular::DataRequest request;
  request.atom_style = this->AtomStyle;
  request.boundary = this->Boundary;
  const granular::LineRequest lines = MakeLineRequest(self->PeriodicLines, self->PointOrigin);
  request.periodic_lines = lines.periodic;
  request.wanted_bonds = [names = this->Cells.GetWanted()](std::string_view name)
  { return names.count(std::string(name)) != 0; };
  granular::DumpRequest& particles = request.particles;
  particles.coordinates = static_cast<granular::Coordinates>(self->Coordinates);
  particles.point_origin = lines.point_origin;
  particles.sort_by_id = self->SortById;
  particles.stride = self->Stride;
  std::copy_n(self->RegionOfInterest, 6, particles.region.begin());
  particles.wanted = [names = this->Points.GetWanted()](const granular::ArrayInfo& array)
  { return names.count(array.name) != 0; };
  const PieceRequest wanted = PieceRequest::Of(output);
  particles.piece = wanted.Piece;
  particles.pieces = wanted.Pieces;
  particles.ranges = true; // whoever shows an array asks for it
  particles.threads = ChooseThreads(self->Threads, self->Series->GetRanks());
  particles.pool = self->Series->Pool;
  return request;
}

//------------------------------------------------------------------------------
void vtkGranularDataFileReader::Internals::FillOutputs(Self* self, vtkInformationVector* outputs,
  const granular::DataRequest& request, granular::DataFrame& frame, Shown& shown)
{
  const granular::Vector3& origin = request.particles.point_origin;
  const granular::DumpFrame& particles = frame.particles;
  auto* points = vtkPolyData::GetData(outputs, 0);
  FillParticles(
    points, frame.particles, false, VertexCells::OnePerPoint, this->Vertices, self->Series->Pool);

  auto* lines = vtkPolyData::GetData(outputs, 1);
  vtkNew<vtkTable> rows;
  FillRows(rows, frame.bonds);
  granular::LineRequest form = MakeLineRequest(self->PeriodicLines, self->PointOrigin);
  form.pool = self->Series->Pool;
  FillLines(lines, rows, frame.bonds, form, shown.Where, shown.Notices);

  auto* box = vtkUnstructuredGrid::GetData(outputs, 2);
  if (request.particles.piece == 0 &&
    !FillBox(box, particles.header.box, particles.coordinates, origin))
  {
    shown.Notices.push_back({ shown.Where, "the box is not finite and not shown" });
  }

  FillFieldData(points->GetFieldData(), particles, origin);
  FillFieldData(lines->GetFieldData(), frame.bonds.table, origin);
  FillFieldData(box->GetFieldData(), particles, origin);
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    FillLeftOut(vtkDataObject::GetData(outputs, port)->GetFieldData(), request.particles);
  }
}

//------------------------------------------------------------------------------
// The ranks exchange rows, if they read together.
void vtkGranularDataFileReader::Internals::Show(
  Self* self, vtkInformationVector* outputs, Shown& shown)
{
  granular::Communicator& ranks = self->Series->GetRanks();
  self->Series->StartFrame(shown.Notices);
  this->Look(self);
  const granular::DataRequest request = this->MakeRequest(self, shown.Port);
  const granular::DumpRequest& particles = request.particles;
  this->Points.CheckNames(shown.Where.path, shown.Notices);
  this->Cells.CheckNames(shown.Where.path, shown.Notices);
  shown.Together =
    AskTogether(ranks, { particles.piece, particles.pieces }, this->Points.GetWanted(),
      [&](granular::ArchiveWriter& form)
      {
        form.number(shown.Number);
        form.text(request.atom_style);
        form.text(request.boundary);
        form.number(request.periodic_lines);
        form.number(particles.coordinates);
        form.number(particles.point_origin);
        form.number(particles.sort_by_id);
        form.number(particles.stride);
        form.number(particles.region);
      });
  granular::SerialCommunicator alone;
  granular::DataFrame frame = granular::read_data(
    shown.Pieces.front(), request, shown.Together ? ranks : alone, shown.Notices, shown.Progress);
  this->FillOutputs(self, outputs, request, frame, shown);
}

//------------------------------------------------------------------------------
vtkGranularDataFileReader::vtkGranularDataFileReader()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfOutputPorts(3);
  this->RepeatedSteps = LAST; // no file is a piece of another
  this->Series->Format = &granular::data_file_format();
  for (const ArrayChoice* choice : { &this->Internal->Points, &this->Internal->Cells })
  {
    choice->GetSelection()->AddObserver(
      vtkCommand::ModifiedEvent, this, &vtkGranularDataFileReader::Modified);
  }
}

//------------------------------------------------------------------------------
vtkGranularDataFileReader::~vtkGranularDataFileReader() = default;

//------------------------------------------------------------------------------
vtkPolyData* vtkGranularDataFileReader::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

//------------------------------------------------------------------------------
vtkPolyData* vtkGranularDataFileReader::GetBonds()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
void vtkGranularDataFileReader::SetAtomStyle(const char* style)
{
  const std::string wanted = style ? style : "";
  if (this->Internal->AtomStyle != wanted)
  {
    this->Internal->AtomStyle = wanted;
    this->Internal->Known = false; // columns are others
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const char* vtkGranularDataFileReader::GetAtomStyle()
{
  return this->Internal->AtomStyle.c_str();
}

//------------------------------------------------------------------------------
void vtkGranularDataFileReader::SetBoundary(const char* boundary)
{
  const std::string wanted = boundary ? boundary : "";
  if (this->Internal->Boundary != wanted)
  {
    this->Internal->Boundary = wanted;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const char* vtkGranularDataFileReader::GetBoundary()
{
  return this->Internal->Boundary.c_str();
}

//------------------------------------------------------------------------------
void vtkGranularDataFileReader::SetStride(vtkTypeInt64 stride)
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
vtkDataArraySelection* vtkGranularDataFileReader::GetPointDataArraySelection()
{
  return this->Internal->Points.GetSelection();
}

//------------------------------------------------------------------------------
vtkDataArraySelection* vtkGranularDataFileReader::GetCellDataArraySelection()
{
  return this->Internal->Cells.GetSelection();
}

//------------------------------------------------------------------------------
int vtkGranularDataFileReader::CanReadFile(const char* fileName)
{
  return granular::is_data_file(fileName ? fileName : "") ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkGranularDataFileReader::ForgetFrames()
{
  this->Internal->Known = false;
}

//------------------------------------------------------------------------------
int vtkGranularDataFileReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 2 ? "vtkUnstructuredGrid" : "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
void vtkGranularDataFileReader::InspectFrames(vtkInformationVector* vtkNotUsed(outputVector))
{
  this->Internal->Look(this);
}

//------------------------------------------------------------------------------
int vtkGranularDataFileReader::RequestData(vtkInformation* request,
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  return this->Series->Run(this, request, outputVector,
    [&](auto& shown) { this->Internal->Show(this, outputVector, shown); });
}

//------------------------------------------------------------------------------
void vtkGranularDataFileReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "AtomStyle: " << this->Internal->AtomStyle << "\n";
  os << indent << "Boundary: " << this->Internal->Boundary << "\n";
  os << indent << "Coordinates: " << this->Coordinates << "\n";
  os << indent << "PeriodicLines: " << this->PeriodicLines << "\n";
  os << indent << "PointOrigin: " << this->PointOrigin[0] << " " << this->PointOrigin[1] << " "
     << this->PointOrigin[2] << "\n";
  os << indent << "SortById: " << (this->SortById ? "On" : "Off") << "\n";
  os << indent << "Stride: " << this->Stride << "\n";
  os << indent << "RegionOfInterest:";
  for (double bound : this->RegionOfInterest)
  {
    os << " " << bound;
  }
  os << "\n" << indent << "PointArrays:\n";
  this->Internal->Points.GetSelection()->PrintSelf(os, indent.GetNextIndent());
  os << indent << "CellArrays:\n";
  this->Internal->Cells.GetSelection()->PrintSelf(os, indent.GetNextIndent());
}
