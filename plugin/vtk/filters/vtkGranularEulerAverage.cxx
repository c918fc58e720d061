// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularEulerAverage.h"

#include "private/dump/dump_output.h"
#include "private/dump/input_frames.h"
#include "private/euler/average_task.h"
#include "private/euler/euler_cells.h"
#include "private/request/guard.h"
#include "private/request/print.h"
#include "private/request/processes.h"
#include "private/request/request_task.h"

#include "granular/averages/average.h"
#include "granular/averages/time_average.h"
#include "granular/numbers/number_print.h"
#include "granular/particles/bounds.h"

#include "vtkDataObjectTypes.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularEulerAverage);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

bool AreGiven(const double bounds[6])
{
  return bounds[0] <= bounds[1] && bounds[2] <= bounds[3] && bounds[4] <= bounds[5];
}
}

//------------------------------------------------------------------------------
class vtkGranularEulerAverage::Task : public FilterTask<vtkGranularEulerAverage, AverageTask>
{
public:
  using FilterTask::FilterTask;

  /**
   * Returns what the properties say of the cells, but for the bounds and the largest diameter.
   */
  static granular::EulerGridRequest DescribeCells(const vtkGranularEulerAverage& self)
  {
    granular::EulerGridRequest request;
    request.by = static_cast<granular::EulerGridRequest::By>(self.CellsBy);
    std::copy_n(self.CellCounts, 3, request.counts.begin());
    std::copy_n(self.CellSize, 3, request.size.begin());
    return request;
  }

private:
  void Average() override
  {
    if (this->Self->TimeAverage)
    {
      this->AverageFrames();
      return;
    }
    granular::EulerAverages averages = this->AverageFrame(this->Inputs);
    this->Cells = std::move(averages.cells);
    this->Fields = std::move(averages.fields);
  }

  void AverageFrames()
  {
    const InputFrames::Part part{ this->Group.rank(), this->Group.size(), 0 };
    std::array<std::optional<InputFrames>, 3> inputs;
    for (std::size_t port = 0; port < inputs.size(); ++port)
    {
      if (this->Inputs[port])
      {
        inputs[port].emplace(this->Self, part, static_cast<int>(port));
      }
    }
    const std::vector<double> times = inputs[0]->GetTimes();
    CheckTimes(times, this->Ranks);
    granular::TimeAverage sums;
    const std::size_t count = std::max<std::size_t>(times.size(), 1);
    for (std::size_t frame = 0; frame < count; ++frame)
    {
      FrameInputs data = {};
      for (std::size_t port = 0; port < data.size(); ++port)
      {
        if (inputs[port])
        {
          inputs[port]->Update(
            times.empty() ? std::nullopt : std::optional(times[frame]), this->Ranks);
          data[port] = inputs[port]->GetData();
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
    granular::FrameView& view = this->Grains->View;
    granular::EulerAverageRequest request;
    this->Choose(request, this->Self->StressArray);
    if (this->HaveContacts() && !request.arrays.stress.empty())
    {
      throw granular::Error("expected a StressArray or contacts (Lines, Walls), got both: contacts "
                            "would count twice");
    }
    const double largest = this->Self->CellsBy == RELATIVE_SIZE
      ? granular::largest_radius(view, request.arrays, this->Group)
      : 0;
    const std::string boundary = view.header.box.boundary;
    if (this->Self->Periodic == NONE)
    {
      view.header.box.boundary.clear();
    }
    this->CheckInput(inputs[0]);
    this->Grid = request.grid = this->MakeGrid(largest);
    request.wanted = this->FindWanted(request.grid);
    request.cells = this->MakeWeights(this->Self->Weights,
      this->Self->KernelBounds == INSIDE ? granular::KernelBounds::Inside
                                         : granular::KernelBounds::None,
      request.arrays);
    request.keep_sums = this->Self->TimeAverage || request.fields.coordination;
    const bool contacts = NeedsContacts(request);
    const granular::Executor executor(this->Threads);
    granular::PartialProgress progress(this->Progress);
    progress.set_part(0, contacts ? 0.5 : 1);
    granular::EulerAverages averages =
      granular::average_in_cells(view, request, this->Group, executor, this->Notices, progress);
    if (contacts)
    {
      progress.set_part(0.5, 1);
      const granular::Box box = view.header.box;
      view.header.box.boundary = boundary; // a contact crosses a face, though nothing has images
      granular::average_contacts(this->FindContacts(inputs, request.tensors, executor, progress),
        view.has_box ? &box : nullptr, request, this->Group, executor, progress, averages);
      this->Ends.reset();
      this->Contacts.reset();
    }
    this->Outside += averages.outside;
    this->Broken += averages.broken;
    return averages;
  }

  granular::EulerGrid MakeGrid(double largestRadius) const
  {
    const vtkGranularEulerAverage& self = *this->Self;
    granular::EulerGridRequest request = DescribeCells(self);
    std::tie(request.lo, request.hi) =
      granular::find_bounds(this->Grains->View, std::to_array(self.Bounds), nullptr);
    if (self.CellsBy == RELATIVE_SIZE)
    {
      if (!(self.CellSizeRelative > 0))
      {
        throw granular::Error(
          "expected a CellSizeRelative above 0, got " + granular::to_text(self.CellSizeRelative));
      }
      request.cutoff = self.CellSizeRelative * 2 * largestRadius;
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
    this->Extent = AskedExtent(this->GetOutputInformation(), ExtentOf(grid));
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      wanted.range.first[axis] = this->Extent[2 * axis];
      wanted.range.last[axis] = std::max(this->Extent[2 * axis], this->Extent[2 * axis + 1]);
    }
    return wanted;
  }

  void Fill() override
  {
    const granular::FrameView& view = this->Grains->View;
    const bool scaled = view.coordinates == granular::Coordinates::Scaled;
    const granular::Vector3 origin = scaled ? granular::Vector3{} : view.point_origin;
    const granular::EulerFrame frame = this->TakeFrame();
    auto* output = this->GetOutput<vtkDataObject>();
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
  }

  granular::EulerGrid Grid;
  CellExtent Extent = {};
};

//------------------------------------------------------------------------------
int vtkGranularEulerAverage::RequestDataObject(vtkInformation* vtkNotUsed(request),
  vtkInformationVector** vtkNotUsed(inputVector), vtkInformationVector* outputVector)
{
  constexpr const char* types[] = { "vtkPolyData", "vtkImageData", "vtkTable" };
  const char* const type = types[this->OutputType];
  vtkInformation* info = outputVector->GetInformationObject(0);
  vtkDataObject* output = info->Get(vtkDataObject::DATA_OBJECT());
  if (!output || !output->IsA(type))
  {
    info->Set(
      vtkDataObject::DATA_OBJECT(), vtk::TakeSmartPointer(vtkDataObjectTypes::NewDataObject(type)));
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
      granular::EulerGridRequest request = Task::DescribeCells(*this);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        request.lo[axis] = given ? this->Bounds[2 * axis] : 0;
        request.hi[axis] = given ? this->Bounds[2 * axis + 1] : 1;
      }
      OfferExtent(info, ExtentOf(granular::make_euler_grid(request)));
    });
  return this->Ranks->EndRequest(this, outcome);
}

//------------------------------------------------------------------------------
void vtkGranularEulerAverage::Execute(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (this->OutputType == IMAGE_DATA)
  {
    ExpectExtent(
      this->CellsBy, this->Bounds); // for a pipeline that goes on after RequestInformation failed
  }
  Task(this, request, inputVector, outputVector).Run();
}

vtkGranularPrintMacro(vtkGranularEulerAverage, OutputType, CellsBy, CellCounts, CellSize,
  CellSizeRelative, Bounds, ProfileAxis, Weights, KernelBounds, Periodic, StressArray, TimeAverage);
