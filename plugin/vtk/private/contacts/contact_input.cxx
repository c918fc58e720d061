// SPDX-License-Identifier: BSD-3-Clause
#include "private/contacts/contact_input.h"

#include "private/dump/dump_input.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
#include "vtkDataArrayRange.h"
#include "vtkDataObject.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <cstddef>
#include <vector>

namespace vtkGranularPrivate
{
namespace
{
/**
 * Returns true if the points are the ends of one line after the other, as those who draw lines leave them.
 */
bool AreEndsInOrder(vtkPointSet* input)
{
  auto* data = vtkPolyData::SafeDownCast(input);
  vtkCellArray* const lines = data ? data->GetLines() : nullptr;
  const vtkIdType points = input->GetNumberOfPoints();
  if (!lines || lines->GetNumberOfCells() != input->GetNumberOfCells() ||
    points != 2 * lines->GetNumberOfCells() || lines->IsHomogeneous() != 2)
  {
    return false;
  }
  const auto isOrdered = [&](const auto& ids)
  {
    vtkIdType next = 0;
    while (next < points && ids[next] == next)
    {
      ++next;
    }
    return next == points;
  };
  vtkDataArray* const ids = lines->GetConnectivityArray();
  if (auto* const narrow = vtkAOSDataArrayTemplate<vtkTypeInt32>::FastDownCast(ids))
  {
    return isOrdered(narrow->GetPointer(0));
  }
  if (auto* const wide = vtkAOSDataArrayTemplate<vtkTypeInt64>::FastDownCast(ids))
  {
    return isOrdered(wide->GetPointer(0));
  }
  return isOrdered(vtk::DataArrayValueRange<1>(ids)); // from VTK 9.6 on there may be others
}

/**
 * The places of the first and the last point of each cell; none for rows of a table.
 */
std::vector<double> ReadEnds(vtkDataObject* input)
{
  auto* lines = vtkPointSet::SafeDownCast(input);
  std::vector<double> points = lines ? ReadAbsolutePoints(lines) : std::vector<double>();
  if (!lines || AreEndsInOrder(lines))
  {
    return points;
  }
  std::vector<double> ends;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < lines->GetNumberOfCells(); ++cell)
  {
    CheckLine(lines, cell);
    lines->GetCellPoints(cell, ids);
    for (const vtkIdType id : { ids->GetId(0), ids->GetId(ids->GetNumberOfIds() - 1) })
    {
      ends.insert(ends.end(), points.begin() + 3 * id, points.begin() + 3 * id + 3);
    }
  }
  return ends;
}
}

GivenContacts::GivenContacts(const std::array<vtkDataObject*, 2>& inputs)
{
  for (std::size_t port = 0; port < inputs.size(); ++port)
  {
    if (vtkDataObject* const input = inputs[port])
    {
      LocalRows& rows = this->Rows[port].emplace(input);
      this->Sources[port] = { &rows.Get(), [input] { return ReadEnds(input); },
        TimestepOf(rows.GetFieldData()) };
    }
  }
}
}
