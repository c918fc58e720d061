// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularEmptyFrame.h"

#include "vtkActor.h"
#include "vtkBoundingBox.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkGranularGrainBlocks.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkPVRenderView.h"

namespace
{
// Returns the numbers of an array of field data, or nullptr where there is no such array.
vtkDataArray* FindNumbers(vtkFieldData* fields, const char* name, vtkIdType count)
{
  vtkDataArray* array = fields ? fields->GetArray(name) : nullptr;
  return array && array->GetNumberOfValues() == count ? array : nullptr;
}

// Adds the corners of the simulation box that field data speak of, where an actor puts them.
void AddBox(vtkBoundingBox& bounds, vtkActor* actor, vtkFieldData* fields)
{
  vtkDataArray* origin = FindNumbers(fields, "BoxOrigin", 3);
  vtkDataArray* edges = FindNumbers(fields, "BoxVectors", 9); // a, b, c
  if (!origin || !edges)
  {
    return;
  }
  const auto number = [](vtkDataArray* of, int i) { // however they are dealt to tuples
    return of->GetComponent(i / of->GetNumberOfComponents(), i % of->GetNumberOfComponents());
  };
  vtkDataArray* zero = FindNumbers(fields, "PointOrigin", 3);
  const bool scaled = vtkGranularGrainBlocks::AreScaled(fields);
  for (int corner = 0; corner < 8; ++corner)
  {
    double place[4] = { 0.0, 0.0, 0.0, 1.0 };
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] = (scaled ? 0.0 : number(origin, axis)) - (zero ? number(zero, axis) : 0.0);
      for (int edge = 0; edge < 3; ++edge)
      {
        const double unit = edge == axis ? 1.0 : 0.0;
        place[axis] += (corner >> edge & 1) * (scaled ? unit : number(edges, 3 * edge + axis));
      }
    }
    if (!actor->vtkProp3D::GetIsIdentity())
    {
      actor->GetMatrix()->MultiplyPoint(place, place);
    }
    bounds.AddPoint(place);
  }
}
}

vtkIdType vtkGranularEmptyFrame::CountPoints(vtkDataObject* data)
{
  vtkIdType points = 0;
  for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets(data))
  {
    points += block->GetNumberOfPoints();
  }
  return points;
}

vtkIdType vtkGranularEmptyFrame::CountOnRanks(vtkDataObject* data)
{
  vtkIdType here = CountPoints(data);
  vtkIdType sum = here;
  if (auto* ranks = vtkMultiProcessController::GetGlobalController())
  {
    ranks->AllReduce(&here, &sum, 1, vtkCommunicator::SUM_OP);
  }
  return sum;
}

void vtkGranularEmptyFrame::SetBounds(vtkInformation* view, vtkPVDataRepresentation* representation,
  vtkDataObject* data, vtkIdType points, vtkActor* actor, const double bounds[6])
{
  vtkBoundingBox box;
  if (points == 0)
  {
    for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets(data))
    {
      AddBox(box, actor, block->GetFieldData());
    }
  }
  double found[6];
  box.GetBounds(found);
  vtkPVRenderView::SetGeometryBounds(view, representation, box.IsValid() ? found : bounds);
}
