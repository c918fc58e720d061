// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularDataFileReader.h"

#include "private/readers/series_reader.h"

#include "granular/data_file/data_file.h"
#include "granular/data_file/read_data.h"

#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <memory>
#include <set>
#include <string>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularDataFileReader);

//------------------------------------------------------------------------------
struct vtkGranularDataFileReader::Internals : vtkGranularSeriesReader::Internals
{
  explicit Internals(vtkGranularDataFileReader* reader)
    : vtkGranularSeriesReader::Internals(reader, granular::data_file_format())
    , Reader(reader)
  {
  }

  std::string GetLookKey() const override { return this->Reader->AtomStyle; }
  Found Look(granular::ArchiveWriter& archive) override;
  void Show(Shown& shown) override;

  vtkGranularDataFileReader* const Reader;
};

//------------------------------------------------------------------------------
// At the first file and the last one.
vtkGranularSeriesReader::Internals::Found vtkGranularDataFileReader::Internals::Look(
  granular::ArchiveWriter&)
{
  AlgorithmProgress progress(this->Reader);
  granular::Notices notices; // are given again where the frame is shown
  Found found;
  for (const std::size_t frame : std::set<std::size_t>{ 0, this->Index.size() - 1 })
  {
    const granular::FramePiece piece = this->Index.first_piece(frame);
    const auto source = granular::open_indexed(piece.file);
    const auto layout = granular::find_data_layout(piece.file, *source, progress);
    AddNames(granular::make_particle_schema(granular::find_data_columns(
               *layout, this->Reader->AtomStyle, piece.file.path, notices)),
      found.Points);
  }
  AddNames(granular::make_data_bond_schema(), found.Cells);
  return found;
}

//------------------------------------------------------------------------------
// The ranks exchange rows, if they read together.
void vtkGranularDataFileReader::Internals::Show(Shown& shown)
{
  granular::DataRequest request;
  request.atom_style = this->Reader->AtomStyle;
  request.boundary = this->Reader->Boundary;
  const granular::LineRequest lines =
    this->MakeLineRequest(this->Reader->PeriodicLines, this->Reader->PointOrigin);
  request.periodic_lines = lines.periodic;
  request.wanted_bonds = this->Cells.MakeFilter();
  request.particles = this->MakeDumpRequest(this->Reader);
  request.particles.piece = shown.Piece.Piece;
  request.particles.pieces = shown.Piece.Pieces;
  request.particles.ranges = true; // whoever shows an array asks for it
  this->Points.CheckNames(shown.Where.path, shown.Notices);
  this->Cells.CheckNames(shown.Where.path, shown.Notices);
  granular::Communicator& group = this->FindGroup(shown,
    [&](granular::ArchiveWriter& form)
    {
      form.text(request.atom_style);
      form.text(request.boundary);
      form.number(request.periodic_lines);
      PassForm(form, request.particles);
    });
  granular::DataFrame frame =
    granular::read_data(shown.Pieces.front(), request, group, shown.Notices, shown.Progress);
  this->FillParticles(shown, frame.particles, lines.point_origin);
  FillBonds(shown, frame.bonds, lines);
  FillLeftOut(shown.Outputs, request.particles);
}

//------------------------------------------------------------------------------
vtkGranularDataFileReader::vtkGranularDataFileReader()
  : Superclass(std::make_unique<Internals>(this))
{
  this->SetPorts({}, { "vtkPolyData", "vtkPolyData", "vtkUnstructuredGrid" });
  this->RepeatedSteps = LAST; // no file is a piece of another
}

//------------------------------------------------------------------------------
vtkPolyData* vtkGranularDataFileReader::GetBonds()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
int vtkGranularDataFileReader::CanReadFile(const char* fileName)
{
  return granular::is_data_file(fileName ? fileName : "") ? 1 : 0;
}

//------------------------------------------------------------------------------
void vtkGranularDataFileReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "AtomStyle: " << this->AtomStyle << "\n";
  os << indent << "Boundary: " << this->Boundary << "\n";
  os << indent << "PeriodicLines: " << this->PeriodicLines << "\n";
}
