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
ChosenCells AddLines(const ChosenLines& lines, vtkPolyData* output)
{
  ChosenCells cells;
  const std::vector<vtkIdType> begins = lines.Rows->FindBegins();
  const std::vector<vtkIdType> ends = lines.Rows->FindEnds();
  for (const std::int64_t row : lines.Wanted)
  {
    const auto at = static_cast<std::size_t>(row);
    for (vtkIdType cell = begins[at]; cell <= ends[at]; ++cell)
    {
      cells.All.push_back(cell);
      cells.Rows.push_back(row);
    }
  }
  if (!output->GetPoints())
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    output->SetPoints(points);
    output->SetLines(vtkNew<vtkCellArray>());
  }
  vtkNew<vtkIdList> corners;
  for (const std::int64_t cell : cells.All)
  {
    const int type = lines.Input->GetCellType(cell);
    if (type != VTK_LINE && type != VTK_POLY_LINE)
    {
      throw granular::UnsupportedError("expected lines as cells, got a cell of the VTK type " +
        std::to_string(type) + " in row " + std::to_string(cell) + " (the first is 0)");
    }
    lines.Input->GetCellPoints(cell, corners);
    output->GetLines()->InsertNextCell(static_cast<int>(corners->GetNumberOfIds()));
    for (const vtkIdType corner : *corners)
    {
      output->GetLines()->InsertCellPoint(
        output->GetPoints()->InsertNextPoint(lines.Input->GetPoint(corner)));
    }
  }
  return cells;
}
}
