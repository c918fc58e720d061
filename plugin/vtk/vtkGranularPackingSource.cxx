// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularPackingSource.h"

#include "private/arrays/arrays.h"
#include "private/dump/dump_output.h"
#include "private/local/bond_lines.h"
#include "private/request/guard.h"
#include "private/request/piece_request.h"
#include "private/request/processes.h"

#include "granular/common/memory_error.h"
#include "granular/packing/bonds.h"
#include "granular/packing/packing.h"
#include "granular/packing/packing_plan.h"

#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <new>
#include <optional>
#include <string>

using namespace vtkGranularPrivate;

namespace
{
enum Ports
{
  GRAINS,
  BOX,
  BONDS,
  NUMBER_OF_PORTS
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
}

vtkStandardNewMacro(vtkGranularPackingSource);

//------------------------------------------------------------------------------
struct vtkGranularPackingSource::Internals
{
  using Self = vtkGranularPackingSource;

  std::string Boundary = "ff ff ff";
  VertexCache Vertices; ///< of the request before

  std::optional<granular::Box> MakeBox(Self* self);
  granular::PackingRequest MakeRequest(Self* self, vtkInformation* output);
  void Fill(Self* self, const granular::PackingPlan& plan, vtkInformationVector* outputs,
    granular::Progress& progress);
  void Run(Self* self, vtkInformation* request, vtkInformationVector* outputs);
};

//------------------------------------------------------------------------------
// None, if it is to be made for the grains.
std::optional<granular::Box> vtkGranularPackingSource::Internals::MakeBox(Self* self)
{
  const auto vector = [](double x, double y, double z) -> granular::Twofold3 {
    return { granular::Twofold{ x, 0 }, granular::Twofold{ y, 0 }, granular::Twofold{ z, 0 } };
  };
  const double* origin = self->BoxOrigin;
  const double* lengths = self->BoxLengths;
  const double* tilts = self->BoxTilts;
  const auto isZero = [](double number) { return number == 0; };
  if (std::all_of(lengths, lengths + 3, isZero))
  {
    if (!std::all_of(tilts, tilts + 3, isZero))
    {
      throw granular::LimitError("expected BoxLengths of the box that BoxTilts are of, got none");
    }
    return {};
  }
  granular::Box box;
  box.origin = vector(origin[0], origin[1], origin[2]);
  box.vectors = { vector(lengths[0], 0, 0), vector(tilts[0], lengths[1], 0),
    vector(tilts[1], tilts[2], lengths[2]) };
  box.tilted = tilts[0] != 0 || tilts[1] != 0 || tilts[2] != 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(lengths[axis] > 0))
    {
      throw granular::LimitError(
        "expected BoxLengths greater than 0, got " + std::to_string(lengths[axis]));
    }
  }
  return box;
}

//------------------------------------------------------------------------------
granular::PackingRequest vtkGranularPackingSource::Internals::MakeRequest(
  Self* self, vtkInformation* output)
{
  granular::PackingRequest request;
  request.arrangement = ArrangementOf(self->Arrangement);
  request.box = this->MakeBox(self);
  std::copy_n(self->BoxOrigin, 3, request.corner.begin());
  constexpr vtkTypeInt64 grainsWithoutBox = 1000;
  request.grains =
    self->NumberOfGrains == 0 && !request.box ? grainsWithoutBox : self->NumberOfGrains;
  request.boundary = this->Boundary;
  request.radii.kind = KindOf(self->Radii);
  request.radii.first = self->Radius;
  request.radii.second = self->SecondRadius;
  request.radii.share = self->SecondShare;
  request.solid_fraction = self->SolidFraction;
  request.spacing = self->Spacing;
  request.speed = self->Speed;
  request.seed = static_cast<std::uint64_t>(self->Seed);
  const PieceRequest wanted = PieceRequest::Of(output);
  request.piece = wanted.Piece;
  request.pieces = wanted.Pieces;
  request.ranges = true; // whoever shows an array asks for it
  request.threads = ChooseThreads(self->Threads, self->Ranks->Get());
  return request;
}

//------------------------------------------------------------------------------
void vtkGranularPackingSource::Internals::Fill(Self* self, const granular::PackingPlan& plan,
  vtkInformationVector* outputs, granular::Progress& progress)
{
  const bool bonded = self->BondFactor != 0;
  granular::PartialProgress part(progress);
  part.set_part(0, bonded ? 0.5 : 1);
  granular::DumpFrame frame = granular::make_packing(plan, part);
  if (bonded)
  {
    part.set_part(0.5, 1);
    granular::GrainBonds bonds = granular::make_bonds(plan, self->BondFactor, part);
    FillBonds(vtkPolyData::GetData(outputs, BONDS), bonds);
  }
  FillParticles(vtkPolyData::GetData(outputs, GRAINS), frame, false, VertexCells::OnePerPoint,
    this->Vertices, nullptr);
  if (plan.request.piece == 0)
  {
    FillBox(vtkUnstructuredGrid::GetData(outputs, BOX), frame.header.box, frame.coordinates, {});
  }
  for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
  {
    FillFieldData(vtkDataObject::GetData(outputs, i)->GetFieldData(), frame, {});
  }
  vtkDataObject::GetData(outputs, BONDS)->GetFieldData()->RemoveArray("Columns"); // of grains
}

//------------------------------------------------------------------------------
void vtkGranularPackingSource::Internals::Run(
  Self* self, vtkInformation* request, vtkInformationVector* outputs)
{
  granular::Communicator& ranks = self->Ranks->Get();
  const int port = request->Has(vtkDemandDrivenPipeline::FROM_OUTPUT_PORT())
    ? std::max(request->Get(vtkDemandDrivenPipeline::FROM_OUTPUT_PORT()), 0)
    : 0;
  AlgorithmProgress own(self);
  granular::SharedProgress progress(own, ranks);
  granular::PartialProgress part(progress);
  const granular::PackingRequest wanted =
    this->MakeRequest(self, outputs->GetInformationObject(port));
  try
  {
    part.set_part(0, 0.6);
    const granular::PackingPlan plan(wanted, part);
    part.set_part(0.6, 1);
    this->Fill(self, plan, outputs, part);
  }
  catch (const std::bad_alloc&)
  {
    throw granular::MemoryError("not enough memory for so many grains and bonds: ask for fewer, or "
                                "use more processes on more machines");
  }
}

//------------------------------------------------------------------------------
vtkGranularPackingSource::vtkGranularPackingSource()
  : Internal(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(NUMBER_OF_PORTS);
}

//------------------------------------------------------------------------------
vtkGranularPackingSource::~vtkGranularPackingSource() = default;

//------------------------------------------------------------------------------
vtkPolyData* vtkGranularPackingSource::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(GRAINS));
}

//------------------------------------------------------------------------------
void vtkGranularPackingSource::SetBoundary(const char* boundary)
{
  const std::string wanted = boundary ? boundary : "";
  if (this->Internal->Boundary != wanted)
  {
    this->Internal->Boundary = wanted;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
const char* vtkGranularPackingSource::GetBoundary()
{
  return this->Internal->Boundary.c_str();
}

//------------------------------------------------------------------------------
int vtkGranularPackingSource::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == BOX ? "vtkUnstructuredGrid" : "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
void vtkGranularPackingSource::Execute(vtkInformation* request,
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  this->Internal->Run(this, request, outputVector);
}

//------------------------------------------------------------------------------
void vtkGranularPackingSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto numbers = [&](const char* name, const double* values)
  { os << indent << name << ": " << values[0] << " " << values[1] << " " << values[2] << "\n"; };
  os << indent << "Arrangement: " << this->Arrangement << "\n";
  os << indent << "NumberOfGrains: " << this->NumberOfGrains << "\n";
  numbers("BoxOrigin", this->BoxOrigin);
  numbers("BoxLengths", this->BoxLengths);
  numbers("BoxTilts", this->BoxTilts);
  os << indent << "Boundary: " << this->Internal->Boundary << "\n";
  os << indent << "Radii: " << this->Radii << "\n";
  os << indent << "Radius: " << this->Radius << "\n";
  os << indent << "SecondRadius: " << this->SecondRadius << "\n";
  os << indent << "SecondShare: " << this->SecondShare << "\n";
  os << indent << "SolidFraction: " << this->SolidFraction << "\n";
  os << indent << "Spacing: " << this->Spacing << "\n";
  os << indent << "BondFactor: " << this->BondFactor << "\n";
  os << indent << "Speed: " << this->Speed << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
}
