// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularGrainsRepresentation.h"

#include "vtkBoundingBox.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
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
// The largest radius that the mapper draws of one data set. VTK keeps the range with the array.
double LargestRadius(vtkPointGaussianMapper* mapper, vtkDataSet* data)
{
  const char* name = mapper->GetScaleArray();
  vtkDataArray* radii = name ? data->GetPointData()->GetArray(name) : nullptr;
  double range[2] = { 1.0, 1.0 };
  if (radii)
  {
    const int components = radii->GetNumberOfComponents();
    const int component = components == 1 ? 0 : mapper->GetScaleArrayComponent();
    const bool one = 0 <= component && component < components;
    radii->GetFiniteRange(range, one ? component : -1); // -1: the length of the vector
    if (range[0] > range[1])
    {
      return 0.0; // not one number among them
    }
  }
  return mapper->GetScaleFactor() * std::max(std::abs(range[0]), std::abs(range[1]));
}

double LargestRadius(vtkPointGaussianMapper* mapper, vtkDataObject* data)
{
  double radius = 0.0;
  for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets(data))
  {
    if (block->GetNumberOfPoints() > 0)
    {
      radius = std::max(radius, LargestRadius(mapper, block));
    }
  }
  return radius;
}

// An actor whose bounds hold the spheres, not their centres alone: cullers and IceT go by them.
class GrainsActor : public vtkOpenGLActor
{
public:
  static GrainsActor* New();
  vtkTypeMacro(GrainsActor, vtkOpenGLActor);

  double* GetBounds() override
  {
    double* centres = this->Superclass::GetBounds();
    auto* mapper = vtkPointGaussianMapper::SafeDownCast(this->Mapper);
    if (!mapper || !centres || !vtkMath::AreBoundsInitialized(centres))
    {
      return centres;
    }
    vtkBoundingBox box(centres);
    box.Inflate(LargestRadius(mapper, mapper->GetInputDataObject(0, 0)));
    box.GetBounds(this->Spheres);
    return this->Spheres;
  }

private:
  double Spheres[6];
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
    vtkBoundingBox box;
    for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets(this->ProcessedData))
    {
      double bounds[6];
      block->GetBounds(bounds);
      box.AddBounds(bounds);
    }
    if (box.IsValid())
    {
      double bounds[6];
      box.Inflate(LargestRadius(this->Mapper, this->ProcessedData));
      box.GetBounds(bounds);
      vtkNew<vtkMatrix4x4> matrix;
      this->Actor->GetMatrix(matrix);
      vtkPVRenderView::SetGeometryBounds(inInfo, this, bounds, matrix);
    }
    if (!this->IsTranslucent())
    {
      outInfo->Remove(vtkPVRenderView::NEED_ORDERED_COMPOSITING());
    }
  }
  return 1;
}
