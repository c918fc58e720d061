// SPDX-License-Identifier: BSD-3-Clause
#include "private/paths/changed_lines.h"

#include "private/paths/changed_rows.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

namespace vtkGranularPrivate
{
void FillLines(const ChosenLines& current, const ChosenLines& lost,
  const std::vector<granular::Change>& changes, granular::Communicator& ranks, vtkPolyData* output)
{
  const ChosenCells now = FindCells(current);
  const ChosenCells before = FindCells(lost);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  output->SetPoints(points);
  vtkNew<vtkCellArray> lines;
  output->SetLines(lines);
  AddLines(current.Input, now.All, output);
  AddLines(lost.Input, before.All, output);
  const vtkIdType count = current.Input->GetNumberOfCells();
  vtkCellData* const data = current.Input->GetCellData();
  vtkCellData* const lostData = lost.Input->GetCellData();
  const ChangedRows both(now.All, count, before.All);
  const std::vector<ArrayForm> forms =
    ShareForms(data, count, lostData, lost.Input->GetNumberOfCells(), ranks);
  both.Pass(forms, data, lostData, output->GetCellData());
  output->GetCellData()->AddArray(MakeChanges(changes, now.Rows, before.All.size()));
}
}
