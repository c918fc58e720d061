// SPDX-License-Identifier: BSD-3-Clause
#include "private/local/lines.h"

#include "private/arrays/arrays.h"

#include "granular/common/words.h"

#include "vtkAbstractArray.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace vtkGranularPrivate
{
std::string LengthName(vtkFieldData* fields)
{
  auto* columns = vtkStringArray::SafeDownCast(fields->GetAbstractArray("Columns"));
  return granular::free_name("length",
    [columns](const std::string& name) { return columns && columns->LookupValue(name) >= 0; });
}

void FillRows(vtkTable* rows, granular::Table& frame)
{
  const auto count = static_cast<vtkIdType>(frame.rows);
  vtkDataSetAttributes* data = rows->GetRowData();
  data->AllocateArrays(static_cast<int>(frame.arrays.size()));
  for (granular::TableArray& from : frame.arrays)
  {
    AddTaken(data, from, count, frame.schema.columns());
  }
}

void FillLines(vtkPolyData* output, vtkTable* rows, granular::Table& frame,
  const granular::Request& request, const granular::Where& where, granular::Notices& notices)
{
  const bool split = request.periodic_lines == granular::PeriodicLines::Split;
  AddRows(output, rows, frame.lines, split, where, notices);
  if (split)
  {
    AddParts(output, frame.lines, frame.first_row);
  }
  FillLines(output, frame.lines, request.pool);
}

void FillLines(
  vtkPolyData* output, granular::Lines& lines, const std::shared_ptr<granular::BlockPool>& pool)
{
  const auto count = static_cast<vtkIdType>(lines.count);
  output->SetPoints(TakePoints(lines.points, 2 * count, false, {}));
  output->SetLines(MakeCells(count, 2, pool));
  const auto rows = static_cast<vtkIdType>(lines.lengths.bytes() / sizeof(double));
  const std::string name = LengthName(output->GetFieldData());
  const auto lengths = TakeDoubles(name.c_str(), lines.lengths, rows, 1);
  output->GetCellData()->AddArray(TakeRows(lengths, lines));
}

vtkSmartPointer<vtkAbstractArray> TakeRows(vtkAbstractArray* array, const granular::Lines& lines)
{
  if (lines.rows.empty())
  {
    return array;
  }
  vtkNew<vtkIdList> rows;
  rows->SetNumberOfIds(static_cast<vtkIdType>(lines.rows.size()));
  std::copy(lines.rows.begin(), lines.rows.end(), rows->GetPointer(0));
  return TakeTuples(array, rows);
}

void AddRows(vtkPolyData* output, vtkTable* rows, const granular::Lines& lines, bool split,
  const granular::Where& where, granular::Notices& notices)
{
  vtkCellData* data = output->GetCellData();
  if (lines.rows.empty())
  {
    data->ShallowCopy(rows->GetRowData()); // without a look at the names
  }
  else
  {
    data->AllocateArrays(static_cast<int>(rows->GetNumberOfColumns()));
    for (vtkIdType i = 0; i < rows->GetNumberOfColumns(); ++i)
    {
      AddNew(data, TakeRows(rows->GetColumn(i), lines));
    }
  }
  for (const char* const own : { RowArray, PartArray })
  {
    vtkSmartPointer<vtkAbstractArray> array = data->GetAbstractArray(own);
    if (!array || !split)
    {
      continue;
    }
    const std::string name = granular::free_name(
      own, [rows](const std::string& each) { return rows->GetColumnByName(each.c_str()); });
    const auto ofRows = std::exchange(array, vtk::TakeSmartPointer(array->NewInstance()));
    array->DeepCopy(ofRows);
    data->AddArray(array); // in its place
    array->SetName(name.c_str());
    notices.push_back({ where,
      std::string("lines have an array '") + own + "' of their own: that of the file is '" + name +
        "'" });
  }
}

void AddParts(vtkPolyData* output, const granular::Lines& lines, vtkTypeInt64 firstRow,
  const std::vector<std::int64_t>& rows)
{
  vtkNew<vtkTypeInt64Array> numbers;
  vtkNew<vtkTypeInt32Array> parts;
  numbers->SetName(RowArray);
  parts->SetName(PartArray);
  numbers->SetNumberOfValues(static_cast<vtkIdType>(lines.count));
  parts->SetNumberOfValues(static_cast<vtkIdType>(lines.count));
  std::int64_t last = -1;
  vtkTypeInt32 part = 0;
  for (vtkIdType line = 0; line < numbers->GetNumberOfValues(); ++line)
  {
    const std::int64_t row = lines.rows.empty() ? line : lines.rows[static_cast<std::size_t>(line)];
    part = row == last ? part + 1 : 0;
    last = row;
    numbers->SetValue(line, firstRow + (rows.empty() ? row : rows[static_cast<std::size_t>(row)]));
    parts->SetValue(line, part);
  }
  output->GetCellData()->AddArray(numbers);
  output->GetCellData()->AddArray(parts);
}
}
