// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularPointAverage.h"

#include "private/contacts/found_contacts.h"
#include "private/dump/particles.h"
#include "private/euler/chosen_fields.h"
#include "private/euler/euler_cells.h"
#include "private/euler/weights.h"
#include "private/request/expect_data.h"
#include "private/request/piece_request.h"
#include "private/request/processes.h"
#include "private/request/text_of.h"

#include "granular/contacts/contact_cells.h"
#include "granular/contacts/point_average.h"

#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularPointAverage);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

constexpr int PointsPort = 3;
}

//------------------------------------------------------------------------------
/**
 * Does one request. Collective.
 */
class vtkGranularPointAverage::Averager
{
public:
  Averager(
    vtkGranularPointAverage* self, vtkInformationVector** inputs, vtkInformationVector* outputs)
    : Self(self)
    , Output(vtkDataObject::GetData(outputs))
    , Wanted(PieceRequest::Of(outputs->GetInformationObject(0)))
    , Ranks(self->Ranks->Get())
    , Own(self)
    , Shared(this->Own, this->Ranks)
    , Progress(this->Shared)
  {
    for (std::size_t port = 0; port < this->Inputs.size(); ++port)
    {
      vtkInformation* info = inputs[port]->GetInformationObject(0);
      this->Inputs[port] = info ? vtkDataObject::GetData(info) : nullptr;
    }
  }

  void Run()
  {
    this->Progress.step(0);
    auto* points = ExpectData<vtkDataSet>(this->Inputs[PointsPort], "a vtkDataSet as Points");
    this->Grains.emplace(this->Inputs[0], this->Ranks);
    this->Together = AreTogether(this->Wanted, false, this->Ranks);
    granular::SerialCommunicator alone;
    this->Average(this->ReadPoints(points), this->Together ? this->Ranks : alone);
    this->Fill(points);
    this->Tell();
    this->Progress.set_part(1, 1);
    this->Progress.step(1);
  }

private:
  /**
   * Absolute places.
   */
  std::vector<double> ReadPoints(vtkDataSet* points) const
  {
    const granular::FrameView& view = this->Grains->View();
    if (view.coordinates == granular::Coordinates::Scaled && points->GetNumberOfPoints() > 0)
    {
      throw granular::UnsupportedError("expected absolute or unwrapped coordinates of the "
                                       "particles, got scaled ones: set Coordinates of the reader");
    }
    std::vector<double> places(static_cast<std::size_t>(3 * points->GetNumberOfPoints()));
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
    {
      double* const place = places.data() + 3 * i;
      points->GetPoint(i, place);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        place[axis] += view.point_origin[axis];
      }
    }
    return places;
  }

  void Average(const std::vector<double>& places, granular::Communicator& ranks)
  {
    const granular::FrameView& view = this->Grains->View();
    const vtkGranularPointAverage& self = *this->Self;
    const ChosenFields chosen =
      ChooseFields(self.ArraySelection, this->Inputs[1] || this->Inputs[2]);
    const bool contacts = chosen.NeedContacts();
    granular::PointAverageRequest request;
    request.arrays = { TextOf(self.VelocityArray), TextOf(self.RadiusArray), TextOf(self.MassArray),
      "" };
    request.fields = chosen.Fields;
    request.pressure = chosen.Pressure;
    request.tensors = chosen.Stress;
    const granular::WeightOptions weights = MakeWeights(self.Kernel, self.KernelWidth, 0,
      self.KernelWidth == 0 ? granular::largest_radius(view, request.arrays, ranks) : 0);
    granular::check_width(weights.width);
    request.kernel = granular::Kernel(weights.kernel, weights.width);
    granular::Notices notices;
    TellOfInputs(this->Inputs[0], view, self.ArraySelection, notices);
    const granular::Executor executor(ChooseThreads(self.Threads, this->Ranks));
    std::optional<FoundContacts> found;
    if (contacts)
    {
      this->Progress.set_part(0, 0.3);
      found.emplace(std::array{ this->Inputs[1], this->Inputs[2] }, *this->Inputs[0], view,
        request.tensors, ranks, executor, notices, this->Progress);
      this->Counts = { found->CountMissing(), found->CountUnplaced(), found->CountBroken() };
    }
    this->Progress.set_part(contacts ? 0.3 : 0, 0.95);
    granular::EulerAverages averages = granular::average_at_points(view, places,
      found ? &found->GetEnds() : nullptr, request, ranks, executor, notices, this->Progress);
    this->Broken = averages.broken;
    if (!averages.fields.contact_normal.empty())
    {
      granular::add_contact_stress(averages.cells, averages.fields);
    }
    this->Frame = MakeFrame(std::move(averages.cells), std::move(averages.fields));
    KeepChosen(self.ArraySelection, this->Frame);
    for (const granular::Notice& notice : notices)
    {
      this->Notices.push_back(granular::to_string(notice));
    }
  }

  void Fill(vtkDataSet* points)
  {
    this->Output->ShallowCopy(points);
    auto* output = vtkDataSet::SafeDownCast(this->Output);
    vtkNew<vtkPointData> fields;
    FillArrays(fields, this->Frame, points->GetNumberOfPoints());
    for (int i = 0; i < fields->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* const array = fields->GetAbstractArray(i);
      if (points->GetPointData()->HasArray(array->GetName()))
      {
        array->SetName((std::string(array->GetName()) + "_avg").c_str());
      }
      output->GetPointData()->AddArray(array);
    }
    for (const char* name : { "timestep", "time" })
    {
      if (vtkAbstractArray* array = this->Inputs[0]->GetFieldData()->GetAbstractArray(name))
      {
        output->GetFieldData()->AddArray(array);
      }
    }
  }

  void Tell()
  {
    std::vector<Processes::Remark> remarks;
    const auto tell = [&](bool is, const std::string& topic, const std::string& text)
    {
      if (is && (this->Ranks.rank() == 0 || !this->Together))
      {
        remarks.push_back({ topic, text });
      }
    };
    tell(this->Broken > 0, "broken",
      std::to_string(this->Broken) +
        " particles are left out: a position, velocity, mass or radius of theirs is no number, "
        "infinite or too large, or a mass or radius is negative");
    tell(this->Counts[0] > 0, "missing",
      std::to_string(this->Counts[0]) +
        " contacts name a particle that is not there: their stress counts as far as it is known");
    tell(this->Counts[1] > 0, "unplaced",
      std::to_string(this->Counts[1]) +
        " contacts name a particle that is not there, and have no line: they are left out");
    tell(this->Counts[2] > 0, "broken contacts",
      std::to_string(this->Counts[2]) +
        " contacts are left out: a number of theirs is no number, infinite or too large");
    for (const std::string& text : this->Notices)
    {
      tell(true, text, text);
    }
    this->Self->Ranks->Warn(this->Self, remarks);
  }

  vtkGranularPointAverage* Self;
  std::array<vtkDataObject*, 4> Inputs = {};
  vtkDataObject* Output;
  PieceRequest Wanted;
  granular::Communicator& Ranks;
  AlgorithmProgress Own;
  granular::SharedProgress Shared;
  granular::PartialProgress Progress;
  bool Together = false;
  std::optional<Particles> Grains;
  granular::EulerFrame Frame;
  std::int64_t Broken = 0;
  std::array<std::int64_t, 3> Counts = {}; ///< contacts: see FoundContacts
  std::vector<std::string> Notices;
};

//------------------------------------------------------------------------------
vtkGranularPointAverage::vtkGranularPointAverage()
{
  this->SetNumberOfInputPorts(4);
}

//------------------------------------------------------------------------------
vtkGranularPointAverage::~vtkGranularPointAverage() = default;

//------------------------------------------------------------------------------
void vtkGranularPointAverage::SetPointsConnection(vtkAlgorithmOutput* output)
{
  this->SetInputConnection(PointsPort, output);
}

//------------------------------------------------------------------------------
int vtkGranularPointAverage::FillOutputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject"); // see RequestDataObject
  return 1;
}

//------------------------------------------------------------------------------
int vtkGranularPointAverage::RequestDataObject(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataObject* points = vtkDataObject::GetData(inputVector[PointsPort]);
  vtkInformation* info = outputVector->GetInformationObject(0);
  vtkDataObject* output = info->Get(vtkDataObject::DATA_OBJECT());
  if (points && (!output || !output->IsA(points->GetClassName())))
  {
    auto made = vtkSmartPointer<vtkDataObject>::Take(points->NewInstance());
    info->Set(vtkDataObject::DATA_OBJECT(), made);
  }
  return 1;
}

//------------------------------------------------------------------------------
// Structured points have an extent, and the times are those of the particles.
int vtkGranularPointAverage::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* points = inputVector[PointsPort]->GetInformationObject(0);
  vtkInformation* output = outputVector->GetInformationObject(0);
  output->CopyEntry(points, Pipeline::WHOLE_EXTENT());
  output->CopyEntry(points, vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT());
  output->CopyEntry(points, vtkDataObject::ORIGIN());
  output->CopyEntry(points, vtkDataObject::SPACING());
  if (output->Has(Pipeline::WHOLE_EXTENT()))
  {
    return 1;
  }
  return this->Superclass::RequestInformation(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
int vtkGranularPointAverage::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  this->Superclass::RequestUpdateExtent(request, inputVector, outputVector);
  const PieceRequest wanted = PieceRequest::Of(outputVector->GetInformationObject(0));
  vtkInformation* points = inputVector[PointsPort]->GetInformationObject(0);
  vtkInformation* output = outputVector->GetInformationObject(0);
  points->Set(Pipeline::UPDATE_PIECE_NUMBER(), wanted.Piece);
  points->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), wanted.Pieces);
  if (output->Has(Pipeline::UPDATE_EXTENT()))
  {
    points->CopyEntry(output, Pipeline::UPDATE_EXTENT());
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkGranularPointAverage::Execute(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  Averager(this, inputVector, outputVector).Run();
}

//------------------------------------------------------------------------------
void vtkGranularPointAverage::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Kernel: " << this->Kernel << "\n";
}
