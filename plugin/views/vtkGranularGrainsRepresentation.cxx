// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularGrainsRepresentation.h"

#include "vtkBoundingBox.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkGranularEmptyFrame.h"
#include "vtkGranularGrainBlocks.h"
#include "vtkGranularGrainShapes.h"
#include "vtkInformation.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLActor.h"
#include "vtkPVRenderView.h"
#include "vtkPointData.h"
#include "vtkProperty.h"
#include "vtkScalarsToColors.h"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace
{
using Place = vtkGranularGrainBlocks::Place;

// From each sphere, not from all centres and the largest radius: how the points are dealt to ranks
// must not show in where the camera is put.
void AddSpheres(double (&bounds)[6], vtkActor* actor, vtkDataSet* data)
{
  auto* mapper = static_cast<vtkGranularGrainBlocks*>(actor->GetMapper());
  const char* name = mapper->GetScaleArray();
  vtkDataArray* radii = name ? data->GetPointData()->GetArray(name) : nullptr;
  const double factor =
    vtkGranularGrainBlocks::LackRadii(data, name) ? 0.0 : mapper->GetGivenFactor();
  const vtkGranularGrainShapes shapes(data, mapper->GetShapeSizes());
  const double without = name && name[0] ? 0.0 : 1.0;
  const double scale = std::cbrt(std::abs(actor->GetMatrix()->Determinant()));
  vtkMatrix4x4* matrix = actor->vtkProp3D::GetIsIdentity() ? nullptr : actor->GetMatrix();
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double centre[4] = { 0.0, 0.0, 0.0, 1.0 };
    data->GetPoint(i, centre);
    if (matrix)
    {
      matrix->MultiplyPoint(centre, centre);
    }
    double radius = radii ? radii->GetComponent(i, 0) : without;
    radius = factor * scale * (shapes.Any() ? shapes.Get(i, radius).Outer : radius);
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

// An actor whose bounds hold the spheres, not their centres alone: cullers and IceT go by them. It draws what its
// mapper counts from a place where that belongs.
class GrainsActor : public vtkOpenGLActor
{
public:
  static GrainsActor* New();
  vtkTypeMacro(GrainsActor, vtkOpenGLActor);

  double* GetBounds() override { return this->Drawn.Of(this, this->GetBlocks()->GetGrains()); }

  double* GetBoundsOf(vtkDataObject* data) { return this->Read.Of(this, data); }

  int GetIsIdentity() override
  {
    return this->GetBlocks()->GetDotsFrom() == Place{} && this->Superclass::GetIsIdentity();
  }

  // The matrices of OpenGL: they are applied to rows.
  void GetKeyMatrices(vtkMatrix4x4*& matrix, vtkMatrix3x3*& normals) override
  {
    this->Superclass::GetKeyMatrices(matrix, normals);
    const Place& from = this->GetBlocks()->GetDotsFrom();
    const double place[4] = { from[0], from[1], from[2], 1.0 };
    this->FromPlace->DeepCopy(matrix);
    this->FromPlace->Transpose();
    double moved[4];
    this->FromPlace->MultiplyPoint(place, moved);
    this->FromPlace->DeepCopy(matrix);
    for (int i = 0; i < 4; ++i)
    {
      this->FromPlace->SetElement(3, i, moved[i]);
    }
    matrix = this->FromPlace;
  }

private:
  vtkGranularGrainBlocks* GetBlocks() { return static_cast<vtkGranularGrainBlocks*>(this->Mapper); }

  vtkNew<vtkMatrix4x4> FromPlace;
  SphereBounds Drawn; // what this rank draws
  SphereBounds Read;  // what was read on this rank, before it is sent anywhere
};
vtkStandardNewMacro(GrainsActor);
}

vtkStandardNewMacro(vtkGranularGrainsRepresentation);

vtkGranularGrainsRepresentation::vtkGranularGrainsRepresentation()
{
  this->Mapper = vtkSmartPointer<vtkGranularGrainBlocks>::New();
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
  this->MarkModified(); // the bounds are others
}

void vtkGranularGrainsRepresentation::SetOpacities(const char* name)
{
  this->Mapper->SetOpacityArray(name && std::string_view(name) != "None" ? name : nullptr);
}

void vtkGranularGrainsRepresentation::SetShapeSizes(int sizes)
{
  static_cast<vtkGranularGrainBlocks*>(this->Mapper.Get())->SetShapeSizes(sizes);
  this->MarkModified(); // the bounds are others
}

void vtkGranularGrainsRepresentation::SetSplatSize(double factor)
{
  if (factor != static_cast<vtkGranularGrainBlocks*>(this->Mapper.Get())->GetGivenFactor())
  {
    this->Superclass::SetSplatSize(factor);
    this->MarkModified();
  }
}

void vtkGranularGrainsRepresentation::SetAmbient(double part)
{
  this->Actor->GetProperty()->SetAmbient(part);
}

void vtkGranularGrainsRepresentation::SetDiffuse(double part)
{
  this->Actor->GetProperty()->SetDiffuse(part);
}

void vtkGranularGrainsRepresentation::SetSpecular(double brightness)
{
  this->Actor->GetProperty()->SetSpecular(brightness);
}

bool vtkGranularGrainsRepresentation::IsTranslucent()
{
  if (this->Actor->GetProperty()->GetOpacity() < 1.0 || this->Mapper->GetOpacityArray())
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
    this->Grains = vtkGranularEmptyFrame::CountOnRanks(this->ProcessedData);
    vtkGranularEmptyFrame::SetBounds(
      inInfo, this, this->ProcessedData, this->Grains, this->Actor, bounds);
    if (!this->IsTranslucent())
    {
      outInfo->Remove(vtkPVRenderView::NEED_ORDERED_COMPOSITING());
    }
  }
  else if (request == vtkPVView::REQUEST_UPDATE_LOD())
  {
    // from ten thousand to a million, a hundred thousand by ParaView's default
    this->MostWhileMoving =
      std::pow(10.0, 4.0 + 2.0 * inInfo->Get(vtkPVRenderView::LOD_RESOLUTION()));
  }
  else if (request == vtkPVView::REQUEST_RENDER())
  {
    auto* mapper = static_cast<vtkGranularGrainBlocks*>(this->Mapper.Get());
    const vtkIdType all =
      std::max(this->Grains, vtkGranularEmptyFrame::CountPoints(mapper->GetGrains()));
    const bool moving = inInfo->Has(vtkPVRenderView::USE_LOD()) != 0;
    mapper->SetEvery(moving
        ? static_cast<vtkIdType>(std::ceil(static_cast<double>(all) / this->MostWhileMoving))
        : 1);
  }
  return 1;
}
