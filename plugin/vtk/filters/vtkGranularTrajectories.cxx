// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularTrajectories.h"

#include "private/arrays/arrays.h"
#include "private/dump/dump_output.h"
#include "private/paths/path_task.h"
#include "private/request/print.h"

#include "granular/paths/trajectories.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularTrajectories);

using Pipeline = vtkStreamingDemandDrivenPipeline;

//------------------------------------------------------------------------------
/**
 * The frames of the tail that was drawn last, by their numbers, their arrays, and when the pipeline was changed last.
 */
struct vtkGranularTrajectories::TailFrames
{
  std::map<std::size_t, granular::PathFrame> Frames;
  std::vector<std::string> Arrays; ///< "*" stands for others where the columns of a file change
  vtkMTimeType Time = 0;
};

//------------------------------------------------------------------------------
class vtkGranularTrajectories::Task : public FilterTask<vtkGranularTrajectories, PathTask>
{
public:
  using FilterTask::FilterTask;

private:
  void Execute() override
  {
    granular::PathTask task = this->Choose();
    task.choose_few(40);
    const std::int64_t tail = this->Self->Tail;
    if (tail > 0)
    {
      vtkInformation* info = this->GetOutputInformation();
      task.keep_tail(info->Has(Pipeline::UPDATE_TIME_STEP())
          ? info->Get(Pipeline::UPDATE_TIME_STEP())
          : task.times().back(),
        tail);
    }
    this->Progress.set_part(0, 0.8);
    std::vector<granular::PathFrame> frames = tail > 0 ? this->LoadTail(task) : task.load();
    this->Progress.set_part(0.8, 1);
    const bool split = this->Self->PeriodicLines == SPLIT;
    granular::Trajectories made = granular::draw_trajectories(task, std::move(frames), split,
      tail == 0, this->Together ? 0 : this->Wanted.Piece, this->Together ? 1 : this->Wanted.Pieces);
    this->FillCells(made);
    this->Output->SetPoints(
      TakePoints(made.points.points, made.points.rows, false, granular::ValueRange()));
    for (granular::TableArray& array : made.points.arrays)
    {
      this->Output->GetPointData()->AddArray(TakeArray(array, made.points.rows, {}));
    }
    this->Output->GetPointData()->SetActiveScalars("speed"); // the colour that ParaView begins with
    if (made.points.header.has_box)
    {
      FillHeader(
        this->Output->GetFieldData(), made.points.header, made.points.coordinates, task.origin);
    }
  }

  /**
   * Loads the frames that the tail before did not have.
   */
  std::vector<granular::PathFrame> LoadTail(granular::PathTask& task)
  {
    auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(this->Self->GetExecutive());
    const vtkMTimeType time = pipeline ? pipeline->GetPipelineMTime() : 0;
    TailFrames& kept = *this->Self->Kept;
    if (kept.Time != time || kept.Arrays != task.request.arrays)
    {
      kept = { {}, task.request.arrays, time };
    }
    std::vector<std::size_t> missing;
    std::ranges::copy_if(task.numbers, std::back_inserter(missing),
      [&](std::size_t number) { return !kept.Frames.contains(number); });
    std::vector<granular::PathFrame> loaded =
      this->Frames.load(missing, task.request, this->Notices, this->Progress);
    for (std::size_t i = 0; i < missing.size(); ++i)
    {
      kept.Frames[missing[i]] = std::move(loaded[i]);
    }
    std::erase_if(kept.Frames,
      [&](const auto& frame)
      { return frame.first < task.numbers.front() || frame.first > task.numbers.back(); });
    std::vector<granular::PathFrame> frames;
    for (const auto& [number, frame] : kept.Frames)
    {
      frames.push_back(frame);
    }
    return frames;
  }

  void FillCells(granular::Trajectories& made)
  {
    vtkNew<vtkCellArray> verts;
    vtkNew<vtkCellArray> lines;
    for (std::size_t i = 0; i < made.firsts.size(); ++i)
    {
      vtkCellArray* cells = static_cast<std::int64_t>(i) < made.vertices ? verts : lines;
      cells->InsertNextCell(static_cast<int>(made.ends[i] - made.firsts[i]));
      for (std::int64_t point = made.firsts[i]; point < made.ends[i]; ++point)
      {
        cells->InsertCellPoint(point);
      }
    }
    this->Output->SetVerts(verts);
    this->Output->SetLines(lines);
    for (granular::TableArray& array : made.cells.arrays)
    {
      this->Output->GetCellData()->AddArray(TakeArray(array, made.cells.rows, {}));
    }
  }

  vtkPolyData* const Output = this->GetOutput<vtkPolyData>();
};

vtkGranularExecuteMacro(vtkGranularTrajectories);
vtkGranularOutputMacro(vtkGranularTrajectories, GetOutput, vtkPolyData, 0);

//------------------------------------------------------------------------------
vtkGranularTrajectories::vtkGranularTrajectories()
  : Kept(std::make_unique<TailFrames>())
{
  this->SetPorts({ Input::Required }, { "vtkPolyData" });
}

//------------------------------------------------------------------------------
vtkGranularTrajectories::~vtkGranularTrajectories() = default;

vtkGranularPrintMacro(vtkGranularTrajectories, PeriodicLines, Tail);
