// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularPackingSource.h"

#include "private/arrays/arrays.h"
#include "private/dump/dump_input.h"
#include "private/dump/dump_output.h"
#include "private/request/print.h"
#include "private/request/request_task.h"

#include "granular/common/error.h"
#include "granular/packing/packing.h"
#include "granular/packing/packing_plan.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <new>
#include <optional>
#include <string>
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

// State files of earlier versions may have values that are gone.
granular::Arrangement ArrangementOf(int value)
{
  switch (value)
  {
    case vtkGranularPackingSource::RANDOM:
      return granular::Arrangement::Random;
    case vtkGranularPackingSource::SIMPLE_CUBIC:
      return granular::Arrangement::SimpleCubic;
    case vtkGranularPackingSource::FACE_CENTRED_CUBIC:
      return granular::Arrangement::FaceCentredCubic;
    case vtkGranularPackingSource::CHAIN:
      return granular::Arrangement::Chain;
    default:
      throw granular::LimitError("expected the Arrangement 0 (Random), 1 (SimpleCubic), "
                                 "2 (FaceCentredCubic) or 4 (Chain), got " +
        std::to_string(value));
  }
}

granular::RadiusChoice::Kind KindOf(int value)
{
  if (value != vtkGranularPackingSource::ONE && value != vtkGranularPackingSource::TWO)
  {
    throw granular::LimitError(
      "expected the Radii 0 (One) or 1 (Two), got " + std::to_string(value));
  }
  return value == vtkGranularPackingSource::ONE ? granular::RadiusChoice::Kind::One
                                                : granular::RadiusChoice::Kind::Two;
}

vtkSmartPointer<vtkAbstractArray> TakeValues(
  const char* name, granular::ValueType type, granular::Block& block, vtkIdType bonds)
{
  granular::TableArray array;
  array.info.name = name;
  array.info.type = type;
  array.info.columns = { 0 };
  array.block = std::move(block);
  return TakeArray(array, bonds, { { name, type } });
}

/**
 * A line for each bond, with two points of its own. Takes over the memory of the bonds.
 */
void FillBonds(vtkPolyData* output, granular::GrainBonds& bonds)
{
  const auto count = static_cast<vtkIdType>(bonds.count);
  output->SetPoints(TakePoints(bonds.points, 2 * count, false, {}));
  output->SetLines(MakeCells(count, 2));
  const auto length =
    TakeValues("equilibrium_length", granular::ValueType::Float64, bonds.equilibrium_length, count);
  vtkNew<vtkDoubleArray> present;
  present->DeepCopy(length);
  present->SetName("length");
  vtkCellData* data = output->GetCellData();
  data->AddArray(TakeValues("id1", granular::ValueType::Int64, bonds.id1, count));
  data->AddArray(TakeValues("id2", granular::ValueType::Int64, bonds.id2, count));
  data->AddArray(TakeValues("btype", granular::ValueType::Int32, bonds.btype, count));
  data->AddArray(length);
  data->AddArray(present);
}
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
    try
    {
      this->Progress.set_part(0, 0.6);
      const granular::PackingPlan plan(this->MakeRequest(), this->Progress);
      this->Fill(plan);
    }
    catch (const std::bad_alloc&)
    {
      throw granular::MemoryError("not enough memory for so many grains and bonds: ask for fewer, "
                                  "or use more processes on more machines");
    }
  }

  /**
   * None, if it is to be made for the particles.
   */
  std::optional<granular::Box> FindBox() const
  {
    const auto& lengths = this->Self->BoxLengths;
    const auto& [xy, xz, yz] = this->Self->BoxTilts;
    if (std::ranges::count(lengths, 0) == 3)
    {
      if (xy != 0 || xz != 0 || yz != 0)
      {
        throw granular::LimitError("expected BoxLengths of the box that BoxTilts are of, got none");
      }
      return {};
    }
    for (const double length : lengths)
    {
      if (!(length > 0))
      {
        throw granular::LimitError(
          "expected BoxLengths greater than 0, got " + std::to_string(length));
      }
    }
    const double edges[] = { lengths[0], 0, 0, xy, lengths[1], 0, xz, yz, lengths[2] };
    return MakeBox(this->Self->BoxOrigin, edges);
  }

  granular::PackingRequest MakeRequest() const
  {
    const vtkGranularPackingSource& self = *this->Self;
    granular::PackingRequest request;
    request.arrangement = ArrangementOf(self.Arrangement);
    request.box = this->FindBox();
    std::copy_n(self.BoxOrigin, 3, request.corner.begin());
    constexpr vtkTypeInt64 particlesWithoutBox = 1000;
    request.particles =
      self.NumberOfGrains == 0 && !request.box ? particlesWithoutBox : self.NumberOfGrains;
    request.boundary = self.Boundary;
    request.radii.kind = KindOf(self.Radii);
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

  void Fill(const granular::PackingPlan& plan)
  {
    const bool bonded = this->Self->BondFactor != 0;
    this->Progress.set_part(0.6, bonded ? 0.8 : 1);
    granular::Table frame = granular::make_packing(plan, this->Progress);
    if (bonded)
    {
      this->Progress.set_part(0.8, 1);
      granular::GrainBonds bonds =
        granular::make_bonds(plan, this->Self->BondFactor, this->Progress);
      FillBonds(this->GetOutput<vtkPolyData>(BONDS), bonds);
    }
    FillParticles(this->GetOutput<vtkPolyData>(PARTICLES), frame, false, VertexCells::OnePerPoint,
      *this->Self->Vertices, nullptr);
    if (plan.request.piece == 0)
    {
      FillBox(this->GetOutput<vtkUnstructuredGrid>(BOX), frame.header.box, frame.coordinates, {});
    }
    for (const int port : { PARTICLES, BOX, BONDS })
    {
      FillFieldData(this->GetOutput<vtkDataObject>(port)->GetFieldData(), frame, {});
    }
    this->GetOutput<vtkDataObject>(BONDS)->GetFieldData()->RemoveArray("Columns"); // of particles
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
