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

#include "granular/averages/cell_averaging.h"
#include "granular/frames/frame_times.h"

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
#include <tuple>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularEulerAverage);

using Pipeline = vtkStreamingDemandDrivenPipeline;

//------------------------------------------------------------------------------
class vtkGranularEulerAverage::Task : public FilterTask<vtkGranularEulerAverage, AverageTask>
{
public:
  using FilterTask::FilterTask;

  /**
   * Returns what the properties say of the cells.
   */
  static granular::ChosenCells DescribeCells(const vtkGranularEulerAverage& self)
  {
    granular::ChosenCells cells;
    cells.grid.by = static_cast<granular::EulerGridRequest::By>(self.CellsBy);
    std::copy_n(self.CellCounts, 3, cells.grid.counts.begin());
    std::copy_n(self.CellSize, 3, cells.grid.size.begin());
    cells.relative_size = self.CellSizeRelative;
    std::copy_n(self.Bounds, 6, cells.bounds.begin());
    if (self.OutputType == PROFILE)
    {
      cells.profile = self.ProfileAxis;
    }
    cells.kernel_bounds =
      self.KernelBounds == INSIDE ? granular::KernelBounds::Inside : granular::KernelBounds::None;
    cells.images = self.Periodic == BOUNDARY;
    cells.time_average = self.TimeAverage;
    if (self.Counts[0] > 0) // an image, which has as many cells at all times
    {
      cells.grid.by = granular::EulerGridRequest::By::Counts;
      cells.grid.counts = self.Counts;
    }
    return cells;
  }

  /**
   * Returns a grid with as many cells as an image has. They are told before the frame is known: if they follow from its box or its particles,
   * from those of the last frame, because runs often begin without particles. Collective.
   */
  static granular::EulerGrid FindImage(vtkGranularEulerAverage* self, granular::Communicator& ranks)
  {
    const granular::ChosenCells cells = DescribeCells(*self);
    granular::ParticleArrayNames names;
    names.radius = self->RadiusArray;
    if (!cells.need_frame())
    {
      return cells.make_grid(nullptr, names, ranks);
    }
    InputFrames input(self, { ranks.rank(), ranks.size(), 0 });
    const std::vector<double> times = input.GetTimes();
    CheckTimes(times, ranks);
    input.Update(times.empty() ? std::nullopt : std::optional(times.back()), ranks);
    const Particles particles(input.GetData(), ranks);
    return cells.make_grid(&particles.View, names, ranks);
  }

private:
  void Execute() override
  {
    const granular::ChosenCells cells = DescribeCells(*this->Self);
    if (this->Self->OutputType == IMAGE_DATA && this->Self->Counts[0] == 0 && cells.need_frame())
    {
      FindImage(this->Self, this->Ranks); // throws again what RequestInformation told
      throw granular::Error("the number of cells was not found before: update again");
    }
    granular::CellAveraging averaging(this->Choose(this->Self->Weights, this->Self->StressArray),
      cells, this->Group, this->Notices);
    if (this->Self->TimeAverage)
    {
      this->AddFrames(averaging);
    }
    else
    {
      this->AddFrame(averaging, this->Inputs);
    }
    this->Fill(averaging.grid(), averaging.finish());
  }

  void AddFrames(granular::CellAveraging& averaging)
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
    const std::vector<std::size_t> numbers =
      granular::frames_in_window({ this->Self->TimeWindow[0], this->Self->TimeWindow[1] },
        std::max<std::size_t>(times.size(), 1), times);
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      FrameInputs data = {};
      for (std::size_t port = 0; port < data.size(); ++port)
      {
        if (inputs[port])
        {
          inputs[port]->Update(
            times.empty() ? std::nullopt : std::optional(times[numbers[i]]), this->Ranks);
          data[port] = inputs[port]->GetData();
        }
      }
      const auto count = static_cast<double>(numbers.size());
      this->Progress.set_part(static_cast<double>(i) / count, static_cast<double>(i + 1) / count);
      this->AddFrame(averaging, data);
    }
  }

  void AddFrame(granular::CellAveraging& averaging, const FrameInputs& inputs)
  {
    const Frame& frame = this->Last.emplace(inputs, this->Ranks);
    averaging.add(
      frame.Input, [this](const granular::EulerGrid& grid) { return this->FindWanted(grid); },
      this->Ranks, this->Progress);
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

  void Fill(const granular::EulerGrid& grid, const granular::EulerFrame& frame)
  {
    const granular::FrameView& view = this->Last->Grains.View;
    const bool scaled = view.coordinates == granular::Coordinates::Scaled;
    const granular::Vector3 origin = scaled ? granular::Vector3{} : view.point_origin;
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
      FillImage(
        vtkImageData::SafeDownCast(output), grid, this->Extent, frame, { this->Extent, 0 }, origin);
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

  std::optional<Frame> Last;
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
  this->Counts = {};
  if (this->OutputType != IMAGE_DATA)
  {
    info->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
    return 1;
  }
  granular::EulerGrid grid;
  const Outcome outcome = Guard(this, *this->Ranks, outputVector,
    [&]
    {
      grid = Task::FindImage(this, this->Ranks->Get());
      OfferExtent(info, ExtentOf(grid));
    });
  if (outcome == Outcome::Done)
  {
    this->Counts = grid.counts; // on all ranks
  }
  return this->Ranks->EndRequest(this, outcome);
}

//------------------------------------------------------------------------------
void vtkGranularEulerAverage::Execute(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  Task(this, request, inputVector, outputVector).Run();
}

vtkGranularPrintMacro(vtkGranularEulerAverage, OutputType, CellsBy, CellCounts, CellSize,
  CellSizeRelative, Bounds, ProfileAxis, Weights, KernelBounds, Periodic, StressArray, TimeAverage,
  TimeWindow);
