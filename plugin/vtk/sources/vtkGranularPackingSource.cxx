// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularPackingSource.h"

#include "private/arrays/arrays.h"
#include "private/dump/dump_output.h"
#include "private/local/lines.h"
#include "private/request/print.h"
#include "private/request/request_task.h"

#include "granular/packing/packing.h"

#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <cstdint>
#include <utility>

using namespace vtkGranularPrivate;

namespace
{
enum Ports
{
  PARTICLES,
  BOX,
  BONDS
};
}

vtkStandardNewMacro(vtkGranularPackingSource);

//------------------------------------------------------------------------------
class vtkGranularPackingSource::Task : public FilterTask<vtkGranularPackingSource>
{
public:
  using FilterTask::FilterTask;

private:
  void Execute() override
  {
    const granular::PackingRequest request = this->MakeRequest();
    this->Fill(
      granular::make_packing(request, this->Self->BondFactor, this->Progress), request.piece == 0);
  }

  granular::PackingRequest MakeRequest() const
  {
    const vtkGranularPackingSource& self = *this->Self;
    granular::PackingRequest request;
    request.arrangement = granular::arrangement_of(self.Arrangement);
    request.corner = std::to_array(self.BoxOrigin);
    request.box = granular::find_box(
      request.corner, std::to_array(self.BoxLengths), std::to_array(self.BoxTilts));
    request.particles = self.NumberOfGrains == 0 && !request.box ? granular::particles_without_box
                                                                 : self.NumberOfGrains;
    request.boundary = self.Boundary;
    request.radii.kind = granular::radii_of(self.Radii);
    request.radii.first = self.Radius;
    request.radii.second = self.SecondRadius;
    request.radii.share = self.SecondShare;
    request.solid_fraction = self.SolidFraction;
    request.spacing = self.Spacing;
    request.speed = self.Speed;
    request.seed = static_cast<std::uint64_t>(self.Seed);
    request.piece = this->Wanted.Piece;
    request.pieces = this->Wanted.Pieces;
    request.ranges = true; // whoever shows an array asks for it
    request.threads = this->Threads;
    return request;
  }

  void Fill(granular::Tables made, bool hasBox)
  {
    granular::Table& frame = made.rows;
    auto* bonds = this->GetOutput<vtkPolyData>(BONDS);
    if (made.bonds.has_lines)
    {
      for (granular::TableArray& array : made.bonds.arrays)
      {
        AddTaken(bonds->GetCellData(), array, made.bonds.rows, {});
      }
      FillLines(bonds, made.bonds.lines, nullptr);
    }
    FillParticles(this->GetOutput<vtkPolyData>(PARTICLES), frame, false, VertexCells::OnePerPoint,
      *this->Self->Vertices, nullptr);
    if (hasBox)
    {
      FillBox(this->GetOutput<vtkUnstructuredGrid>(BOX), frame.header.box, frame.coordinates, {});
    }
    for (const int port : { PARTICLES, BOX, BONDS })
    {
      FillFieldData(this->GetOutput<vtkDataObject>(port)->GetFieldData(), frame, {});
    }
    bonds->GetFieldData()->RemoveArray("Columns"); // of particles
  }
};

vtkGranularExecuteMacro(vtkGranularPackingSource, true);
vtkGranularOutputMacro(vtkGranularPackingSource, GetOutput, vtkPolyData, PARTICLES);

//------------------------------------------------------------------------------
vtkGranularPackingSource::vtkGranularPackingSource()
  : Vertices(std::make_unique<VertexCache>())
{
  this->SetPorts({}, { "vtkPolyData", "vtkUnstructuredGrid", "vtkPolyData" });
}

//------------------------------------------------------------------------------
vtkGranularPackingSource::~vtkGranularPackingSource() = default;

vtkGranularPrintMacro(vtkGranularPackingSource, Arrangement, NumberOfGrains, BoxOrigin, BoxLengths,
  BoxTilts, Boundary, Radii, Radius, SecondRadius, SecondShare, SolidFraction, Spacing, BondFactor,
  Speed, Seed);
