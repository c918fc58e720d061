// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularVTKParticleReader.h"

#include "private/readers/series_reader.h"
#include "private/readers/vtk_data.h"
#include "private/request/guard.h"
#include "private/request/print.h"

#include "granular/formats/vtk_files/vtk_series.h"

#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <memory>
#include <optional>
#include <string>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularVTKParticleReader);

//------------------------------------------------------------------------------
struct vtkGranularVTKParticleReader::Internals : vtkGranularSeriesReader::Internals
{
  explicit Internals(vtkGranularVTKParticleReader* reader)
    : vtkGranularSeriesReader::Internals(reader, VtkKind)
    , Reader(reader)
  {
  }

  std::optional<granular::Box> Fill(vtkPolyData* output, std::size_t frame, Shown& shown);
  void Show(Shown& shown) override;

  vtkGranularVTKParticleReader* const Reader;
  VertexCache Vertices;
};

//------------------------------------------------------------------------------
// Each rank reads the whole frame, and keeps its piece. Returns the box.
std::optional<granular::Box> vtkGranularVTKParticleReader::Internals::Fill(
  vtkPolyData* output, std::size_t frame, Shown& shown)
{
  const auto pieces = this->Run.index().pieces(frame);
  const std::string& path = pieces.front().file.path;
  vtkSmartPointer<vtkDataObject> data = ReadData(pieces, false, shown.Progress);
  const vtkSmartPointer<vtkDataObject> block = TakeBlock(data, "Domain");
  if (data->IsA("vtkMultiBlockDataSet"))
  {
    data = TakeBlock(data, "Particles");
  }
  if (data) // LIGGGHTS writes no block of no particles
  {
    auto* const points = ExpectData<vtkPointSet>(
      data, "particles, which are points, or else GranularMeshReader", { path });
    const bool other = frame != shown.Number; // of which only the arrays are wanted
    const auto [first, last] = shown.Piece.RangeOf(other ? 0 : points->GetNumberOfPoints());
    FillVtkParticles(output, points, first, last);
  }
  return ReadVtkBox(block, path);
}

//------------------------------------------------------------------------------
void vtkGranularVTKParticleReader::Internals::Show(Shown& shown)
{
  auto* particles = vtkPolyData::GetData(shown.Outputs, 0);
  auto* box = vtkUnstructuredGrid::GetData(shown.Outputs, 1);
  const std::optional<granular::Box> found = this->Fill(particles, shown.Number, shown);
  const std::size_t filled = FindFilled(this->Run.index(), shown.Number);
  if (particles->GetPointData()->GetNumberOfArrays() == 0 && filled != shown.Number)
  {
    this->Fill(particles, filled, shown);
  }
  if (particles->GetNumberOfPoints() > 0)
  {
    particles->SetVerts(this->Vertices.Get(particles->GetNumberOfPoints(), true, this->Pool));
  }
  granular::FrameHeader header;
  header.timestep = shown.Pieces.front().entry.timestep;
  header.has_box = found.has_value();
  if (found)
  {
    const std::string& boundary = this->Reader->Boundary;
    header.box = *found;
    header.box.boundary = boundary.empty() ? "" : granular::parse_boundary(boundary);
  }
  if (found && shown.Piece.Piece == 0)
  {
    vtkGranularPrivate::FillBox(box, header.box, granular::Coordinates::Absolute, {});
  }
  FillHeader(particles->GetFieldData(), header, granular::Coordinates::Absolute, {});
  FillHeader(box->GetFieldData(), header, granular::Coordinates::Absolute, {});
}

//------------------------------------------------------------------------------
vtkGranularVTKParticleReader::vtkGranularVTKParticleReader()
  : Superclass(std::make_unique<Internals>(this))
{
  this->SetPorts({}, { "vtkPolyData", "vtkUnstructuredGrid" });
}

//------------------------------------------------------------------------------
int vtkGranularVTKParticleReader::CanReadFile(const char* fileName)
{
  return granular::is_vtk_particles(fileName ? fileName : "") ? 1 : 0;
}

vtkGranularOutputMacro(vtkGranularVTKParticleReader, GetOutput, vtkPolyData, 0);
vtkGranularPrintMacro(vtkGranularVTKParticleReader, Boundary);
