// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularTrajectories.h"

#include "private/arrays/arrays.h"
#include "private/dump/dump_output.h"
#include "private/paths/path_task.h"
#include "private/request/print.h"

#include "granular/paths/paths.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <bit>
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
    this->Choose();
    this->ChooseFew(40);
    if (this->Self->Tail > 0)
    {
      this->KeepTail();
    }
    this->Progress.set_part(0, 0.8);
    std::vector<granular::PathFrame> frames = this->Self->Tail > 0
      ? this->LoadTail()
      : this->Frames.Load(this->Numbers, this->Request, this->Notices, this->Progress);
    this->Progress.set_part(0.8, 1);
    this->Paths = this->Join(std::move(frames), this->Self->PeriodicLines == SPLIT);
    if (this->Self->Tail == 0)
    {
      this->NoteAbsent(this->Paths.ids);
    }
    this->Lines = granular::draw_paths(this->Paths, this->Origin);
    this->ChooseLines();
    this->FillLines();
    this->FillPoints();
    this->FillHeader();
  }

  /**
   * Leaves the last frame at or before the current time, and so many before it.
   */
  void KeepTail()
  {
    const std::vector<double> times = this->GetTimes();
    vtkInformation* info = this->GetOutputInformation();
    const double time = info->Has(Pipeline::UPDATE_TIME_STEP())
      ? info->Get(Pipeline::UPDATE_TIME_STEP())
      : times.back();
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    const auto end = std::max<std::ptrdiff_t>(next - times.begin(), 1);
    const auto first = std::max<std::ptrdiff_t>(end - 1 - this->Self->Tail, 0);
    this->Numbers.assign(this->Numbers.begin() + first, this->Numbers.begin() + end);
  }

  /**
   * Loads the frames that the tail before did not have.
   */
  std::vector<granular::PathFrame> LoadTail()
  {
    auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(this->Self->GetExecutive());
    const vtkMTimeType time = pipeline ? pipeline->GetPipelineMTime() : 0;
    TailFrames& kept = *this->Self->Kept;
    if (kept.Time != time || kept.Arrays != this->Request.arrays)
    {
      kept = { {}, this->Request.arrays, time };
    }
    std::vector<std::size_t> missing;
    std::ranges::copy_if(this->Numbers, std::back_inserter(missing),
      [&](std::size_t number) { return !kept.Frames.contains(number); });
    std::vector<granular::PathFrame> loaded =
      this->Frames.Load(missing, this->Request, this->Notices, this->Progress);
    for (std::size_t i = 0; i < missing.size(); ++i)
    {
      kept.Frames[missing[i]] = std::move(loaded[i]);
    }
    std::erase_if(kept.Frames,
      [&](const auto& frame)
      { return frame.first < this->Numbers.front() || frame.first > this->Numbers.back(); });
    std::vector<granular::PathFrame> frames;
    for (const auto& [number, frame] : kept.Frames)
    {
      frames.push_back(frame);
    }
    return frames;
  }

  /**
   * Leaves the lines of the requested piece, where this rank makes the whole.
   */
  void ChooseLines()
  {
    this->LastLine = this->Lines.paths.size();
    if (this->Together || this->Wanted.Pieces == 1)
    {
      return;
    }
    const auto [first, last] = this->RangeOf(static_cast<vtkTypeInt64>(this->Paths.ids.size()));
    const auto begin_of = [&](vtkTypeInt64 path)
    {
      return static_cast<std::size_t>(
        std::ranges::lower_bound(this->Lines.paths, path) - this->Lines.paths.begin());
    };
    this->FirstLine = begin_of(first);
    this->LastLine = begin_of(last);
  }

  std::int64_t FirstPoint() const { return this->Lines.begins[this->FirstLine]; }
  std::int64_t LastPoint() const { return this->Lines.begins[this->LastLine]; }

  /**
   * The cells: vertices come first, as VTK counts them.
   */
  void FillLines()
  {
    vtkNew<vtkCellArray> verts;
    vtkNew<vtkCellArray> lines;
    vtkNew<vtkTypeInt64Array> ids;
    vtkNew<vtkDoubleArray> lengths;
    ids->SetName("id");
    lengths->SetName("length");
    for (const bool single : { true, false })
    {
      for (std::size_t line = this->FirstLine; line < this->LastLine; ++line)
      {
        const std::int64_t first = this->Lines.begins[line];
        const std::int64_t end = this->Lines.begins[line + 1];
        if ((end - first == 1) != single)
        {
          continue;
        }
        vtkCellArray* cells = single ? verts : lines;
        cells->InsertNextCell(static_cast<int>(end - first));
        for (std::int64_t point = first; point < end; ++point)
        {
          cells->InsertCellPoint(point - this->FirstPoint());
        }
        ids->InsertNextValue(this->Paths.ids[static_cast<std::size_t>(this->Lines.paths[line])]);
        lengths->InsertNextValue(this->Lines.lengths[line]);
      }
    }
    this->Output->SetVerts(verts);
    this->Output->SetLines(lines);
    this->Output->GetCellData()->AddArray(ids);
    this->Output->GetCellData()->AddArray(lengths);
  }

  void FillPoints()
  {
    const std::int64_t count = this->LastPoint() - this->FirstPoint();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetNumberOfPoints(count);
    std::copy_n(this->Lines.points.data() + 3 * this->FirstPoint(), 3 * count,
      static_cast<double*>(points->GetVoidPointer(0)));
    this->Output->SetPoints(points);

    const std::vector<double> times = this->GetTimes();
    const std::vector<double> speeds = granular::find_speeds(this->Paths, times);
    const auto frame_of = [&](std::int64_t place)
    { return static_cast<std::size_t>(this->Paths.frames[static_cast<std::size_t>(place)]); };
    this->AddNumbers("time", 1, [&](std::int64_t place, int) { return times[frame_of(place)]; });
    this->AddIntegers("timestep", 1,
      [&](std::int64_t place, int) { return this->Paths.headers[frame_of(place)].timestep; });
    this->AddNumbers(
      "speed", 1, [&](std::int64_t place, int) { return speeds[static_cast<std::size_t>(place)]; });
    this->Output->GetPointData()->SetActiveScalars("speed"); // the colour that ParaView begins with
    const std::vector<std::int64_t> firsts = this->FindFirsts();
    this->AddNumbers("displacement", 3,
      [&](std::int64_t place, int axis)
      {
        const double* const all = this->Paths.points.data() + axis;
        return all[3 * place] - all[3 * firsts[static_cast<std::size_t>(place)]];
      });
    for (const granular::PathArray& array : this->Paths.arrays)
    {
      const auto word = [&](std::int64_t place, int i)
      { return array.words[static_cast<std::size_t>(place * array.size + i)]; };
      if (array.integers)
      {
        this->AddIntegers(array.name.c_str(), array.size, word);
      }
      else
      {
        this->AddNumbers(array.name.c_str(), array.size,
          [&](std::int64_t place, int i) { return std::bit_cast<double>(word(place, i)); });
      }
    }
  }

  /**
   * Returns for each place the first one of its path.
   */
  std::vector<std::int64_t> FindFirsts() const
  {
    std::vector<std::int64_t> firsts(this->Paths.frames.size());
    for (std::size_t path = 0; path < this->Paths.ids.size(); ++path)
    {
      std::fill(firsts.begin() + this->Paths.begins[path],
        firsts.begin() + this->Paths.begins[path + 1], this->Paths.begins[path]);
    }
    return firsts;
  }

  /**
   * Adds an array of numbers, which at() gives for places; between two places they are interpolated.
   */
  template <typename At>
  void AddNumbers(const char* name, int size, const At& at)
  {
    this->AddArray<vtkDoubleArray>(name, size,
      [&](std::int64_t place, double part, int i)
      { return part == 0 ? at(place, i) : (1 - part) * at(place, i) + part * at(place + 1, i); });
  }

  template <typename At>
  void AddIntegers(const char* name, int size, const At& at)
  {
    this->AddArray<vtkTypeInt64Array>(
      name, size, [&](std::int64_t place, double, int i) { return at(place, i); });
  }

  template <typename Array, typename At>
  void AddArray(const char* name, int size, const At& at)
  {
    vtkNew<Array> array;
    array->SetName(name);
    array->SetNumberOfComponents(size);
    array->SetNumberOfTuples(this->LastPoint() - this->FirstPoint());
    auto* to = array->GetPointer(0);
    for (std::int64_t point = this->FirstPoint(); point < this->LastPoint(); ++point)
    {
      const auto from = static_cast<std::size_t>(point);
      for (int i = 0; i < size; ++i)
      {
        *to++ = at(this->Lines.places[from], this->Lines.parts[from], i);
      }
    }
    this->Output->GetPointData()->AddArray(array);
  }

  /**
   * The box and the form of the points.
   */
  void FillHeader()
  {
    const granular::FrameHeader& header = this->Paths.headers.back();
    const bool inside = this->Self->PeriodicLines == SPLIT;
    if (header.has_box)
    {
      vtkGranularPrivate::FillHeader(this->Output->GetFieldData(), header,
        inside ? granular::Coordinates::Absolute : granular::Coordinates::Unwrapped, this->Origin);
    }
  }

  vtkPolyData* const Output = this->GetOutput<vtkPolyData>();
  granular::Paths Paths;
  granular::PathLines Lines;
  std::size_t FirstLine = 0;
  std::size_t LastLine = 0;
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
