// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularGrainsRepresentation.h"

#include "vtkBoundingBox.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLActor.h"
#include "vtkPVRenderView.h"
#include "vtkPointData.h"
#include "vtkPointGaussianMapper.h"
#include "vtkProperty.h"
#include "vtkScalarsToColors.h"

#include <algorithm>
#include <cmath>

namespace
{
// From each sphere, not from all centres and the largest radius: how the points are dealt to ranks
// must not show in where the camera is put.
void AddSpheres(double (&bounds)[6], vtkActor* actor, vtkDataSet* data)
{
  auto* mapper = vtkPointGaussianMapper::SafeDownCast(actor->GetMapper());
  const char* name = mapper->GetScaleArray();
  vtkDataArray* radii = name ? data->GetPointData()->GetArray(name) : nullptr;
  const double factor = mapper->GetScaleFactor();
  vtkMatrix4x4* matrix = actor->GetIsIdentity() ? nullptr : actor->GetMatrix();
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double centre[4] = { 0.0, 0.0, 0.0, 1.0 };
    data->GetPoint(i, centre);
    if (matrix)
    {
      matrix->MultiplyPoint(centre, centre);
    }
    double radius = factor * (radii ? radii->GetComponent(i, 0) : 1.0);
    if (!(radius > 0.0 && std::isfinite(radius)))
    {
      radius = 0.0; // nothing is drawn of it
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      bounds[2 * axis] = std::min(bounds[2 * axis], centre[axis] - radius);
      bounds[2 * axis + 1] = std::max(bounds[2 * axis + 1], centre[axis] + radius);
    }
  }
}

// The box around the spheres that an actor makes of some data, in the world's coordinates.
class SphereBounds
{
public:
  double* Of(vtkActor* actor, vtkDataObject* data)
  {
    const vtkMTimeType changed =
      std::max({ actor->GetMTime(), actor->GetMapper()->GetMTime(), data ? data->GetMTime() : 0 });
    if (data != this->Data || this->Time < changed)
    {
      vtkBoundingBox().GetBounds(this->Bounds); // of nothing
      for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets(data))
      {
        AddSpheres(this->Bounds, actor, block);
      }
      this->Data = data;
      this->Time = changed;
    }
    return this->Bounds;
  }

private:
  double Bounds[6];
  vtkDataObject* Data = nullptr; // only compared
  vtkMTimeType Time = 0;
};

// An actor whose bounds hold the spheres, not their centres alone: cullers and IceT go by them.
class GrainsActor : public vtkOpenGLActor
{
public:
  static GrainsActor* New();
  vtkTypeMacro(GrainsActor, vtkOpenGLActor);

  double* GetBounds() override
  {
    return this->Drawn.Of(this, this->Mapper->GetInputDataObject(0, 0));
  }

  double* GetBoundsOf(vtkDataObject* data) { return this->Read.Of(this, data); }

private:
  SphereBounds Drawn; // what this rank draws
  SphereBounds Read;  // what was read on this rank, before it is sent anywhere
};
vtkStandardNewMacro(GrainsActor);
}

vtkStandardNewMacro(vtkGranularGrainsRepresentation);

vtkGranularGrainsRepresentation::vtkGranularGrainsRepresentation()
{
  this->Actor = vtkSmartPointer<GrainsActor>::New();
  this->Actor->SetMapper(this->Mapper);
}

vtkGranularGrainsRepresentation::~vtkGranularGrainsRepresentation() = default;

void vtkGranularGrainsRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "IsTranslucent: " << this->IsTranslucent() << "\n";
}

void vtkGranularGrainsRepresentation::SetRadiusArray(const char* name)
{
  this->SelectScaleArray(0, 0, 0, 0, name);
}

bool vtkGranularGrainsRepresentation::IsTranslucent()
{
  if (this->Actor->GetProperty()->GetOpacity() < 1.0)
  {
    return true;
  }
  vtkInformation* color = this->GetInputArrayInformation(0);
  const char* name =
    color->Has(vtkDataObject::FIELD_NAME()) ? color->Get(vtkDataObject::FIELD_NAME()) : nullptr;
  // An array of colours may have opacities in it, on this rank or another.
  return name && name[0] &&
    (this->Mapper->GetColorMode() == VTK_COLOR_MODE_DIRECT_SCALARS ||
      !this->Mapper->GetLookupTable()->IsOpaque());
}

int vtkGranularGrainsRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo)
{
  if (!this->Superclass::ProcessViewRequest(request, inInfo, outInfo))
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    double* bounds = static_cast<GrainsActor*>(this->Actor.Get())->GetBoundsOf(this->ProcessedData);
    vtkPVRenderView::SetGeometryBounds(inInfo, this, bounds);
    if (!this->IsTranslucent())
    {
      outInfo->Remove(vtkPVRenderView::NEED_ORDERED_COMPOSITING());
    }
  }
  return 1;
}
