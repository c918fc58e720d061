// SPDX-License-Identifier: BSD-3-Clause
#include "private/paths/changed_lines.h"

#include "private/local/local_rows.h"
#include "private/paths/changed_rows.h"

#include "granular/common/error.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cstddef>
#include <string>

namespace vtkGranularPrivate
{
namespace
{
/**
 * The cells of some rows: lines that were split have several.
 */
struct Cells
{
  std::vector<vtkIdType> All;
  std::vector<vtkIdType> Rows; ///< of each
};

Cells FindCells(const ChosenLines& lines)
{
  Cells cells;
  const std::vector<vtkIdType> begins = lines.Rows->FindBegins();
  const std::vector<vtkIdType> ends = lines.Rows->FindEnds();
  for (const vtkIdType row : lines.Wanted)
  {
    const auto at = static_cast<std::size_t>(row);
    for (vtkIdType cell = begins[at]; cell <= ends[at]; ++cell)
    {
      cells.All.push_back(cell);
      cells.Rows.push_back(row);
    }
  }
  return cells;
}

void AddLines(vtkPointSet* from, const std::vector<vtkIdType>& cells, vtkPolyData* output)
{
  vtkPoints* const points = output->GetPoints();
  vtkCellArray* const lines = output->GetLines();
  vtkNew<vtkIdList> ends;
  for (const vtkIdType cell : cells)
  {
    const int type = from->GetCellType(cell);
    if (type != VTK_LINE && type != VTK_POLY_LINE)
    {
      throw granular::UnsupportedError("expected lines as cells, got a cell of the VTK type " +
        std::to_string(type) + " in row " + std::to_string(cell) + " (the first is 0)");
    }
    from->GetCellPoints(cell, ends);
    lines->InsertNextCell(static_cast<int>(ends->GetNumberOfIds()));
    for (vtkIdType i = 0; i < ends->GetNumberOfIds(); ++i)
    {
      lines->InsertCellPoint(points->InsertNextPoint(from->GetPoint(ends->GetId(i))));
    }
  }
}
}

void FillLines(const ChosenLines& current, const ChosenLines& lost,
  const std::vector<granular::Change>& changes, granular::Communicator& ranks, vtkPolyData* output)
{
  const Cells now = FindCells(current);
  const Cells before = FindCells(lost);
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
