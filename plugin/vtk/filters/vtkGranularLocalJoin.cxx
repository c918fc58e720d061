// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularLocalJoin.h"

#include "private/arrays/arrays.h"
#include "private/dump/dump_input.h"
#include "private/local/lines.h"
#include "private/local/local_rows.h"
#include "private/request/print.h"
#include "private/request/request_task.h"

#include "granular/lines/local_join.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <string>
#include <vector>

using namespace vtkGranularPrivate;

vtkStandardNewMacro(vtkGranularLocalJoin);

//------------------------------------------------------------------------------
class vtkGranularLocalJoin::Task : public FilterTask<vtkGranularLocalJoin>
{
public:
  using FilterTask::FilterTask;

private:
  void Execute() override
  {
    Particles particles(this->GetInput(0), this->Ranks);
    const vtkSmartPointer<vtkDataObject> data = RowsOfTimestep(
      this->Self, 1, this->GetInput(0), PieceOfInput(this->Wanted, this->Ranks), this->Ranks);
    LocalRows rows(data);
    granular::LocalJoinRequest request;
    request.periodic_lines = static_cast<granular::PeriodicLines>(this->Self->PeriodicLines);
    request.averages = this->Self->Averages;
    request.differences = this->Self->Differences;
    request.equilibrium_length_array = this->Self->EquilibriumLengthArray;
    request.equilibrium_length = this->Self->EquilibriumLength;
    request.threads = this->Threads;
    // lines of a single time, or none, are those of all times
    if (this->Self->GetInputInformation(1, 0)->Length(
          vtkStreamingDemandDrivenPipeline::TIME_STEPS()) > 1)
    {
      request.timesteps = CompareTimesteps(this->GetInput(0)->GetFieldData(), data->GetFieldData());
    }
    if (!this->Together)
    {
      const auto range = this->RangeOf(rows.Count());
      request.first_row = range.first;
      rows.Get().keep(range);
    }
    const vtkIdType cells = rows.Get().cells().rows;
    granular::LocalJoin joined = granular::join_local(
      particles.View, rows.Get(), request, this->Group, this->Notices, this->Progress);
    rows.PassCells(joined.cells, this->Output->GetCellData(),
      joined.cells.empty() && joined.lines.count == cells);
    this->Fill(joined, rows.HasParts());
    this->FillFields(this->Output->GetFieldData(), data->GetFieldData(), joined.box_of_lines);
    FillLines(this->Output, joined.lines, nullptr);
  }

  /**
   * Adds the arrays that are made to those of the rows.
   */
  void Fill(granular::LocalJoin& joined, bool hadParts)
  {
    vtkCellData* data = this->Output->GetCellData();
    for (const char* name : { "elongation", "strain" }) // of the input
    {
      data->RemoveArray(name);
    }
    if (hadParts)
    {
      data->RemoveArray(PartArray);
    }
    vtkPointData* points = vtkPointSet::SafeDownCast(this->GetInput(0))->GetPointData();
    for (granular::EndArray& array : joined.arrays)
    {
      const auto lines = static_cast<vtkIdType>(array.values.bytes() / sizeof(double)) / array.size;
      auto made = TakeDoubles(array.name.c_str(), array.values, lines, array.size);
      const std::string from = array.name.substr(0, array.name.rfind('_'));
      if (vtkAbstractArray* named = points->GetAbstractArray(from.c_str()))
      {
        made->CopyComponentNames(named);
      }
      data->AddArray(TakeRows(made, joined.lines));
    }
    if (this->Self->PeriodicLines == SPLIT)
    {
      AddParts(this->Output, joined.lines, joined.first_row, joined.rows);
    }
  }

  void FillFields(vtkFieldData* fields, vtkFieldData* rows, bool boxIsOfLines) const
  {
    fields->PassData(this->GetInput(0)->GetFieldData());
    fields->RemoveArray("Columns"); // of particles
    std::vector<const char*> ofLines = { "Columns", "RowLabel" };
    if (boxIsOfLines)
    {
      ofLines.insert(ofLines.end(), { "BoxOrigin", "BoxVectors", "BoxBounds", "Boundary" });
    }
    for (const char* name : ofLines)
    {
      if (vtkAbstractArray* array = rows->GetAbstractArray(name))
      {
        fields->AddArray(array);
      }
    }
  }

  vtkPolyData* const Output = this->GetOutput<vtkPolyData>();
};

vtkGranularExecuteMacro(vtkGranularLocalJoin);
vtkGranularOutputMacro(vtkGranularLocalJoin, GetOutput, vtkPolyData, 0);

//------------------------------------------------------------------------------
vtkGranularLocalJoin::vtkGranularLocalJoin()
{
  this->SetPorts({ Input::Required, Input::Required }, { "vtkPolyData" });
}

vtkGranularPrintMacro(vtkGranularLocalJoin, PeriodicLines, Averages, Differences,
  EquilibriumLengthArray, EquilibriumLength);
