// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularCompare.h"

#include "private/arrays/arrays.h"
#include "private/dump/dump_input.h"
#include "private/local/local_rows.h"
#include "private/paths/compared_frames.h"
#include "private/request/guard.h"
#include "private/request/print.h"
#include "private/request/request_task.h"

#include "granular/paths/compare_frames.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularCompare);

namespace
{
bool HasArray(vtkDataSetAttributes* data, const char* name)
{
  return data && data->HasArray(name) != 0;
}
}

//------------------------------------------------------------------------------
class vtkGranularCompare::Task : public FilterTask<vtkGranularCompare>
{
public:
  using FilterTask::FilterTask;

private:
  void Execute() override
  {
    this->Request.reference = static_cast<granular::ReferenceFrame>(this->Self->Reference);
    this->Request.reference_time = this->Self->ReferenceTime;
    this->Request.differences = this->Self->Differences;
    this->Request.mass_array = this->Self->MassArray;
    this->Request.threads = this->Threads;
    if (!this->Together)
    {
      this->Request.piece = this->Wanted.Piece;
      this->Request.pieces = this->Wanted.Pieces;
    }
    this->ReadFrames();
    this->Compare();
    for (vtkPolyData* output : this->Outputs)
    {
      output->GetFieldData()->PassData(this->Current[0]->GetFieldData());
    }
  }

  void ReadFrames()
  {
    KeptFrames& frames = *this->Self->Frames;
    frames.Begin(this->Self, { this->Group.rank(), this->Group.size(), 0 }, this->Ranks);
    this->Current = frames.GetShown();
    this->Request.times = frames.GetTimes();
    this->Request.shown = frames.GetShownNumber();
    this->Request.reference_number =
      granular::find_reference(this->Request, [&] { return this->FindFirst(frames); });
    this->Reference = frames.Get(this->Self, this->Request.reference_number, this->Ranks);
    frames.End(this->Self->Reference == PREVIOUS);
  }

  /**
   * Returns the first frame; for particles the first one that has any.
   */
  std::size_t FindFirst(KeptFrames& frames)
  {
    auto* shown = vtkDataSet::SafeDownCast(this->Current[0]);
    std::int64_t particles = shown && HasArray(shown->GetPointData(), "id") ? 1 : 0;
    this->Ranks.sum({ &particles, 1 });
    return particles > 0 ? frames.FindFirst(this->Self, this->Ranks) : 0;
  }

  void Compare()
  {
    const bool ofLines = this->IsOfLines();
    const bool hasLines = this->Current.size() > 1;
    if (ofLines && hasLines)
    {
      throw granular::Error(
        "expected particles with the point array 'id' as Input of Lines, got lines");
    }
    std::array<granular::ComparedInput, 2> inputs;
    std::array<std::optional<vtkGranularPrivate::Particles>, 2> particles;
    std::array<std::optional<LocalRows>, 2> rows;
    std::array<vtkPointSet*, 2> lines = {};
    const std::array<FrameData*, 2> frames = { &this->Current, &this->Reference };
    for (std::size_t i = 0; i < 2; ++i)
    {
      if (!ofLines)
      {
        inputs[i].particles = &particles[i].emplace((*frames[i])[0], this->Ranks).View;
      }
      if (ofLines || hasLines)
      {
        lines[i] = ExpectData<vtkPointSet>((*frames[i])[hasLines ? 1 : 0],
          "lines with points (GranularLocalJoin makes them of a table)");
        inputs[i].lines = &rows[i].emplace(lines[i]).Get();
      }
    }
    granular::ComparedFrames compared = granular::compare_frames(
      inputs[0], inputs[1], this->Request, this->Group, this->Notices, this->Progress);
    if (ofLines || hasLines)
    {
      this->FillLines(compared.lines, lines, this->Outputs[hasLines ? 1 : 0]);
    }
    if (!ofLines)
    {
      this->FillParticles(compared.particles);
    }
  }

  /**
   * Returns true if some rank has lines at the first input, in either frame, and none has particles.
   */
  bool IsOfLines() const
  {
    std::array<std::int64_t, 2> counts = {};
    for (vtkDataObject* data : { this->Current[0].Get(), this->Reference[0].Get() })
    {
      if (auto* set = vtkDataSet::SafeDownCast(data))
      {
        vtkCellData* cells = set->GetCellData();
        counts[0] += HasArray(set->GetPointData(), "id") ? 1 : 0;
        counts[1] += HasArray(cells, "id1") && HasArray(cells, "id2") ? 1 : 0;
      }
    }
    this->Group.sum(counts);
    return counts[0] == 0 && counts[1] > 0;
  }

  void FillLines(granular::ComparedRows& compared, const std::array<vtkPointSet*, 2>& lines,
    vtkPolyData* output) const
  {
    AddLines(lines[0], compared.rows, output);
    AddLines(lines[1], compared.lost, output);
    this->FillArrays(
      compared, lines[0]->GetCellData(), lines[1]->GetCellData(), output->GetCellData());
  }

  void FillArrays(granular::ComparedRows& compared, vtkDataSetAttributes* current,
    vtkDataSetAttributes* reference, vtkDataSetAttributes* output) const
  {
    const ChangedRows both(compared.rows, compared.lost);
    both.Pass(current, reference, this->Group, output);
    for (granular::TableArray& array : compared.made.arrays)
    {
      output->AddArray(TakeArray(array, both.Count(), {}));
    }
  }

  void FillParticles(granular::ComparedRows& compared) const
  {
    auto* current = vtkPointSet::SafeDownCast(this->Current[0]);
    auto* reference = vtkPointSet::SafeDownCast(this->Reference[0]);
    this->FillArrays(compared, current->GetPointData(), reference->GetPointData(),
      this->Outputs[0]->GetPointData());
    const ChangedRows both(compared.rows, compared.lost);
    vtkDataArray* now = current->GetPoints() ? current->GetPoints()->GetData() : nullptr;
    vtkDataArray* before = reference->GetPoints() ? reference->GetPoints()->GetData() : nullptr;
    const bool single = now && now->GetNumberOfTuples() > 0
      ? now->GetDataType() == VTK_FLOAT
      : before && before->GetDataType() == VTK_FLOAT;
    vtkNew<vtkPoints> points;
    points->SetData(vtkDataArray::SafeDownCast(
      both.Combine({ "Points", single ? VTK_FLOAT : VTK_DOUBLE, 3 }, now, before)));
    this->Outputs[0]->SetPoints(points);
    this->Outputs[0]->SetVerts(MakeCells(both.Count(), 1));
  }

  const std::array<vtkPolyData*, 2> Outputs = { this->GetOutput<vtkPolyData>(0),
    this->GetOutput<vtkPolyData>(1) };
  granular::FrameCompareRequest Request;
  FrameData Current;
  FrameData Reference;
};

vtkGranularExecuteMacro(vtkGranularCompare);
vtkGranularOutputMacro(vtkGranularCompare, GetOutput, vtkPolyData, 0);
vtkGranularOutputMacro(vtkGranularCompare, GetLinesOutput, vtkPolyData, 1);

//------------------------------------------------------------------------------
vtkGranularCompare::vtkGranularCompare()
  : Frames(std::make_unique<KeptFrames>())
{
  this->SetPorts({ Input::Required, Input::Optional }, { "vtkPolyData", "vtkPolyData" });
}

//------------------------------------------------------------------------------
vtkGranularCompare::~vtkGranularCompare() = default;

vtkGranularPrintMacro(vtkGranularCompare, Reference, ReferenceTime, Differences, MassArray);
