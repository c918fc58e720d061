// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularFewGrains.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cstdint>

namespace
{
// Spreads ids that follow each other: the high half of the product with the golden ratio.
std::uint64_t HashOf(std::uint64_t id)
{
  return id * 0x9e3779b97f4a7c15U >> 32U;
}
}

vtkSmartPointer<vtkPolyData> vtkGranularFewGrains::Choose(vtkPolyData* data, vtkIdType every)
{
  vtkDataArray* ids = data->GetPointData()->GetArray("id");
  ids = ids && ids->GetNumberOfComponents() == 1 ? ids : nullptr;
  vtkNew<vtkIdList> chosen;
  vtkNew<vtkIdList> places;
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const auto id = static_cast<std::int64_t>(ids ? ids->GetComponent(i, 0) : i);
    if (HashOf(static_cast<std::uint64_t>(id)) % static_cast<std::uint64_t>(every) == 0)
    {
      places->InsertNextId(chosen->InsertNextId(i));
    }
  }
  auto few = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(data->GetPoints()->GetDataType());
  data->GetPoints()->GetPoints(chosen, points);
  few->SetPoints(points);
  few->GetPointData()->CopyAllOn();
  few->GetPointData()->CopyAllocate(data->GetPointData(), chosen->GetNumberOfIds());
  few->GetPointData()->CopyData(data->GetPointData(), chosen, places);
  few->GetFieldData()->ShallowCopy(data->GetFieldData());
  return few;
}
