// SPDX-License-Identifier: BSD-3-Clause
#include "private/local/chosen_lines.h"

#include "private/local/local_rows.h"

#include "granular/common/error.h"

#include "vtkCellArray.h"
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
ChosenCells FindCells(const ChosenLines& lines)
{
  ChosenCells cells;
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
