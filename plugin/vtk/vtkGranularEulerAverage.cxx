// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularEulerAverage.h"

#include "private/arrays/arrays.h"
#include "private/contacts/found_contacts.h"
#include "private/dump/dump_output.h"
#include "private/dump/input_frames.h"
#include "private/dump/particles.h"
#include "private/euler/chosen_fields.h"
#include "private/euler/euler_cells.h"
#include "private/euler/weights.h"
#include "private/request/guard.h"
#include "private/request/piece_request.h"
#include "private/request/processes.h"
#include "private/request/text_of.h"

#include "granular/contacts/contact_cells.h"
#include "granular/euler/average.h"
#include "granular/euler/time_average.h"
#include "granular/numbers/number_print.h"

#include "vtkDataArraySelection.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularEulerAverage);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

/**
 * The data of the inputs at one time: particles, contacts between them, contacts with walls; null where there is none.
 */
using FrameInputs = std::array<vtkDataObject*, 3>;

bool AreGiven(const double bounds[6])
{
  return bounds[0] <= bounds[1] && bounds[2] <= bounds[3] && bounds[4] <= bounds[5];
}

}

//------------------------------------------------------------------------------
/**
 * Does one request. Collective.
 */
class vtkGranularEulerAverage::Averager
{
public:
  Averager(
    vtkGranularEulerAverage* self, vtkInformationVector** inputs, vtkInformationVector* outputs)
    : Self(self)
    , Inputs(DataOf(inputs))
    , Info(outputs->GetInformationObject(0))
    , Wanted(PieceRequest::Of(this->Info))
    , Ranks(self->Ranks->Get())
    , Own(self)
    , Shared(this->Own, this->Ranks)
    , Progress(this->Shared)
  {
  }

  void Run()
  {
    this->Progress.step(0);
    this->Together = AreTogether(this->Wanted, false, this->Ranks);
    if (this->Self->TimeAverage)
    {
      this->AverageFrames();
    }
    else
    {
      granular::EulerAverages averages = this->AverageFrame(this->Inputs);
      this->Cells = std::move(averages.cells);
      this->Fields = std::move(averages.fields);
    }
    if (!this->Fields.contact_normal.empty())
    {
      granular::add_contact_stress(this->Cells, this->Fields);
    }
    this->Tell();
    this->Fill();
  }

private:
  static FrameInputs DataOf(vtkInformationVector** inputs)
  {
    FrameInputs data = {};
    for (std::size_t port = 0; port < data.size(); ++port)
    {
      vtkInformation* info = inputs[port]->GetInformationObject(0);
      data[port] = info ? vtkDataObject::GetData(info) : nullptr;
    }
    return data;
  }

  bool HaveContacts() const { return this->Inputs[1] || this->Inputs[2]; }

  void AverageFrames()
  {
    const bool own = IsOwn(this->Wanted, this->Ranks);
    const InputFrames::Part part{ own ? this->Wanted.Piece : 0, own ? this->Wanted.Pieces : 1, 0 };
    std::vector<std::unique_ptr<InputFrames>> inputs;
    for (int port = 0; port < static_cast<int>(this->Inputs.size()); ++port)
    {
      if (this->Inputs[static_cast<std::size_t>(port)])
      {
        inputs.push_back(std::make_unique<InputFrames>(this->Self, part, port));
      }
    }
    std::vector<double> times = inputs[0]->GetTimes();
    CheckTimes(times, this->Ranks);
    granular::TimeAverage sums;
    const std::size_t count = std::max<std::size_t>(times.size(), 1);
    for (std::size_t frame = 0; frame < count; ++frame)
    {
      FrameInputs data = {};
      auto next = inputs.begin();
      for (std::size_t port = 0; port < data.size(); ++port)
      {
        if (this->Inputs[port])
        {
          (*next)->Update(times.empty() ? std::nullopt : std::optional(times[frame]), this->Ranks);
          data[port] = (*next++)->GetData();
        }
      }
      this->Progress.set_part(static_cast<double>(frame) / static_cast<double>(count),
        static_cast<double>(frame + 1) / static_cast<double>(count));
      const granular::EulerAverages averages = this->AverageFrame(data);
      granular::do_together(this->Ranks, [&] { sums.add(averages); });
    }
    this->Cells = sums.cells();
    this->Fields = sums.fields();
  }

  granular::EulerAverages AverageFrame(const FrameInputs& inputs)
  {
    this->Grains.emplace(inputs[0], this->Ranks);
    granular::Notices notices;
    granular::SerialCommunicator alone;
    granular::EulerAverages averages =
      this->Average(inputs, this->Together ? this->Ranks : alone, notices);
    this->Outside += averages.outside;
    this->Broken += averages.broken;
    for (const granular::Notice& notice : notices)
    {
      this->Notices.insert(granular::to_string(notice));
    }

    return averages;
  }

  /**
   * Of the grains that these processes have together.
   */
  granular::EulerAverages Average(
    const FrameInputs& inputs, granular::Communicator& ranks, granular::Notices& notices)
  {
    granular::FrameView& view = this->Grains->View();
    granular::EulerAverageRequest request;
    request.arrays = { TextOf(this->Self->VelocityArray), TextOf(this->Self->RadiusArray),
      TextOf(this->Self->MassArray), TextOf(this->Self->StressArray) };
    const double largest = this->Self->CellsBy == RELATIVE_SIZE
      ? granular::largest_radius(view, request.arrays, ranks)
      : 0;
    const std::string boundary = view.header.box.boundary;
    if (this->Self->Periodic == NONE)
    {
      view.header.box.boundary.clear();
    }
    TellOfInputs(inputs[0], view, this->Self->ArraySelection, notices);
    request.grid = this->MakeGrid(largest);
    request.wanted = this->FindWanted(request.grid);
    const bool smooth = this->Self->Weights >= GAUSSIAN && this->Self->KernelWidth == 0;
    request.cells = MakeWeights(this->Self->Weights, this->Self->KernelWidth,
      this->Self->KernelBounds, smooth ? granular::largest_radius(view, request.arrays, ranks) : 0);
    const bool contacts = this->ChooseFields(request);
    this->Grid = request.grid;
    const granular::Executor executor(ChooseThreads(this->Self->Threads, this->Ranks));
    granular::PartialProgress progress(this->Progress);
    progress.set_part(0, contacts ? 0.5 : 1);
    granular::EulerAverages averages =
      granular::average_in_cells(view, request, ranks, executor, notices, progress);
    if (contacts)
    {
      progress.set_part(0.5, 1);
      const granular::Box box = view.header.box;
      view.header.box.boundary = boundary; // a contact crosses a face, though nothing has images
      const FoundContacts found({ inputs[1], inputs[2] }, *inputs[0], view, request.tensors, ranks,
        executor, notices, progress);
      granular::average_contacts(found.GetEnds(), view.has_box ? &box : nullptr, request, ranks,
        executor, progress, averages);
      this->Missing += found.CountMissing();
      this->Unplaced += found.CountUnplaced();
      this->BrokenContacts += found.CountBroken();
    }
    return averages;
  }

  /**
   * Returns true if contacts have a part in any array.
   */
  bool ChooseFields(granular::EulerAverageRequest& request) const
  {
    const bool contacts = this->HaveContacts();
    if (contacts && !request.arrays.stress.empty())
    {
      throw granular::Error("expected a StressArray or contacts (Lines, Walls), got both: contacts "
                            "would count twice");
    }
    const ChosenFields chosen =
      vtkGranularPrivate::ChooseFields(this->Self->ArraySelection, contacts);
    request.fields = chosen.Fields;
    request.pressure = chosen.Pressure;
    request.tensors = chosen.Stress;
    request.keep_sums = this->Self->TimeAverage || request.fields.coordination;
    return chosen.NeedContacts();
  }

  granular::EulerGrid MakeGrid(double largestRadius) const
  {
    granular::EulerGridRequest request;
    std::tie(request.lo, request.hi) = this->Grains->FindBounds(this->Self->Bounds, nullptr);
    const vtkGranularEulerAverage& self = *this->Self;
    switch (self.CellsBy)
    {
      case COUNTS:
        std::copy_n(self.CellCounts, 3, request.counts.begin());
        request.by = granular::EulerGridRequest::By::Counts;
        break;
      case SIZE:
        std::copy_n(self.CellSize, 3, request.size.begin());
        request.by = granular::EulerGridRequest::By::Size;
        break;
      case RELATIVE_SIZE:
        if (!(self.CellSizeRelative > 0))
        {
          throw granular::Error(
            "expected a CellSizeRelative above 0, got " + granular::to_text(self.CellSizeRelative));
        }
        request.cutoff = self.CellSizeRelative * 2 * largestRadius;
        request.by = granular::EulerGridRequest::By::Cutoff;
        break;
    }
    granular::EulerGrid grid = granular::make_euler_grid(request);
    for (std::size_t axis = 0; self.OutputType == PROFILE && axis < 3; ++axis)
    {
      grid.counts[axis] =
        axis == static_cast<std::size_t>(self.ProfileAxis) ? grid.counts[axis] : 1;
    }
    return grid;
  }

  /**
   * The cells that the pipeline asks this process for.
   */
  granular::WantedCells FindWanted(const granular::EulerGrid& grid)
  {
    granular::WantedCells wanted = granular::WantedCells::all(grid);
    if (this->Self->OutputType != IMAGE_DATA)
    {
      std::tie(wanted.first, wanted.last) = this->Wanted.RangeOf(grid.size());
      return wanted;
    }
    this->Extent = AskedExtent(this->Info, ExtentOf(grid));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      wanted.range.first[axis] = this->Extent[2 * axis];
      wanted.range.last[axis] = std::max(this->Extent[2 * axis], this->Extent[2 * axis + 1]);
    }
    return wanted;
  }

  /**
   * Each thing once, whatever the number of frames.
   */
  void Tell()
  {
    const auto count = [&](vtkTypeInt64 number, const char* what)
    {
      if (number > 0)
      {
        this->Notices.insert(std::to_string(number) + what);
      }
    };
    count(this->Outside, " particles are outside of all cells, and in none");
    count(this->Broken,
      " particles are left out: a position, velocity, mass, radius or stress of theirs is no "
      "number, infinite or too large, or a mass or radius is negative");
    count(this->Missing,
      " contacts name a particle that is not there: their stress counts as far as it is known");
    count(this->Unplaced,
      " contacts name a particle that is not there, and have no line: they are left out");
    count(this->BrokenContacts,
      " contacts are left out: a number of theirs is no number, infinite or too large");
    for (const std::string& text : this->Notices)
    {
      if (this->Ranks.rank() == 0 || !this->Together)
      {
        vtkWarningWithObjectMacro(this->Self, << text);
      }
    }
  }

  void Fill()
  {
    const granular::FrameView& view = this->Grains->View();
    const bool scaled = view.coordinates == granular::Coordinates::Scaled;
    const granular::Vector3 origin = scaled ? granular::Vector3{} : view.point_origin;
    granular::EulerFrame frame = MakeFrame(std::move(this->Cells), std::move(this->Fields));
    KeepChosen(this->Self->ArraySelection, frame);
    vtkDataObject* output = this->Info->Get(vtkDataObject::DATA_OBJECT());
    if (this->Self->OutputType == POINTS)
    {
      FillPoints(vtkPolyData::SafeDownCast(output), frame, 0, frame.cells, origin);
    }
    else if (this->Self->OutputType == PROFILE)
    {
      FillTable(vtkTable::SafeDownCast(output), frame, 0, frame.cells, this->Self->ProfileAxis);
    }
    else
    {
      FillImage(vtkImageData::SafeDownCast(output), this->Grid, this->Extent, frame,
        { this->Extent, 0 }, origin);
    }
    vtkFieldData* data = output->GetFieldData();
    data->PassData(this->Inputs[0]->GetFieldData());
    data->RemoveArray("Columns"); // of particles
    if (view.has_box)
    {
      FillHeader(data, view.header, granular::Coordinates::Absolute, origin);
    }
    if (this->Self->TimeAverage) // it is of no moment
    {
      data->RemoveArray("timestep");
      data->RemoveArray("time");
    }
    this->Progress.set_part(1, 1);
    this->Progress.step(1);
  }

  vtkGranularEulerAverage* Self;
  FrameInputs Inputs;
  vtkInformation* Info;
  PieceRequest Wanted;
  granular::Communicator& Ranks;
  AlgorithmProgress Own;
  granular::SharedProgress Shared;
  granular::PartialProgress Progress;
  std::optional<Particles> Grains;
  bool Together = false;
  granular::EulerGrid Grid;
  CellExtent Extent = {};
  granular::EulerCells Cells;
  granular::EulerFields Fields;
  vtkTypeInt64 Outside = 0; ///< particles, of all frames
  vtkTypeInt64 Broken = 0;
  vtkTypeInt64 Missing = 0; ///< contacts: see FoundContacts
  vtkTypeInt64 Unplaced = 0;
  vtkTypeInt64 BrokenContacts = 0;
  std::set<std::string> Notices;
};

//------------------------------------------------------------------------------
vtkGranularEulerAverage::vtkGranularEulerAverage() = default;

//------------------------------------------------------------------------------
vtkGranularEulerAverage::~vtkGranularEulerAverage()
{
  this->SetStressArray(nullptr);
}

//------------------------------------------------------------------------------
int vtkGranularEulerAverage::FillOutputPortInformation(int vtkNotUsed(port), vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject"); // see RequestDataObject
  return 1;
}

//------------------------------------------------------------------------------
int vtkGranularEulerAverage::RequestDataObject(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  vtkDataObject* output = info->Get(vtkDataObject::DATA_OBJECT());
  if (this->OutputType == POINTS && !vtkPolyData::SafeDownCast(output))
  {
    info->Set(vtkDataObject::DATA_OBJECT(), vtkNew<vtkPolyData>());
  }
  if (this->OutputType == PROFILE && !vtkTable::SafeDownCast(output))
  {
    info->Set(vtkDataObject::DATA_OBJECT(), vtkNew<vtkTable>());
  }
  if (this->OutputType == IMAGE_DATA && !vtkImageData::SafeDownCast(output))
  {
    info->Set(vtkDataObject::DATA_OBJECT(), vtkNew<vtkImageData>());
  }
  return 1;
}

namespace
{
/**
 * Throws where the extent of an image cannot be known before the particles.
 */
void ExpectExtent(int cellsBy, const double bounds[6])
{
  if (cellsBy == vtkGranularEulerAverage::RELATIVE_SIZE)
  {
    throw granular::Error(
      "expected points as output for CellSizeRelative, got an image, whose extent must be "
      "known before the particles");
  }
  if (cellsBy == vtkGranularEulerAverage::SIZE && !AreGiven(bounds))
  {
    throw granular::Error(
      "expected Bounds for an image of cells of a CellSize, got none: give Bounds, "
      "CellCounts, or output points");
  }
}
}

//------------------------------------------------------------------------------
// The extent of an image is known before its data.
int vtkGranularEulerAverage::RequestInformation(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  if (this->TimeAverage)
  {
    info->Remove(Pipeline::TIME_STEPS());
    info->Remove(Pipeline::TIME_RANGE());
  }
  info->Remove(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT());
  info->Remove(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST());
  info->Remove(Pipeline::WHOLE_EXTENT());
  if (this->OutputType != IMAGE_DATA)
  {
    info->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
    return 1;
  }
  const Outcome outcome = Guard(this, *this->Ranks, outputVector,
    [&]
    {
      ExpectExtent(this->CellsBy, this->Bounds);
      const bool given = AreGiven(this->Bounds);
      granular::EulerGridRequest request;
      request.lo = given ? granular::Vector3{ this->Bounds[0], this->Bounds[2], this->Bounds[4] }
                         : granular::Vector3{};
      request.hi = given ? granular::Vector3{ this->Bounds[1], this->Bounds[3], this->Bounds[5] }
                         : granular::Vector3{ 1, 1, 1 };
      request.by = this->CellsBy == SIZE ? granular::EulerGridRequest::By::Size
                                         : granular::EulerGridRequest::By::Counts;
      std::copy_n(this->CellCounts, 3, request.counts.begin());
      std::copy_n(this->CellSize, 3, request.size.begin());
      const granular::EulerGrid grid = granular::make_euler_grid(request);
      OfferExtent(info, ExtentOf(grid));
    });
  return this->Ranks->EndRequest(this, outcome);
}

//------------------------------------------------------------------------------
void vtkGranularEulerAverage::Execute(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (this->OutputType == IMAGE_DATA)
  {
    ExpectExtent(
      this->CellsBy, this->Bounds); // for a pipeline that goes on after RequestInformation failed
  }
  Averager(this, inputVector, outputVector).Run();
}

//------------------------------------------------------------------------------
void vtkGranularEulerAverage::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, const auto& values)
  {
    os << indent << name << ":";
    for (const auto& value : values)
    {
      os << " " << value;
    }
    os << "\n";
  };
  os << indent << "OutputType: " << this->OutputType << "\n";
  os << indent << "CellsBy: " << this->CellsBy << "\n";
  print("CellCounts", this->CellCounts);
  print("CellSize", this->CellSize);
  os << indent << "CellSizeRelative: " << this->CellSizeRelative << "\n";
  print("Bounds", this->Bounds);
  os << indent << "ProfileAxis: " << this->ProfileAxis << "\n";
  os << indent << "Weights: " << this->Weights << "\n";
  os << indent << "KernelBounds: " << this->KernelBounds << "\n";
  os << indent << "Periodic: " << this->Periodic << "\n";
  os << indent << "StressArray: " << TextOf(this->StressArray) << "\n";
  os << indent << "TimeAverage: " << (this->TimeAverage ? "On" : "Off") << "\n";
}
