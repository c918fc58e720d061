// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularGrainsRepresentation.h"

#include "vtkAbstractArray.h"
#include "vtkBoundingBox.h"
#include "vtkCamera.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLActor.h"
#include "vtkOpenGLPointGaussianMapper.h"
#include "vtkPVRenderView.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkShaderProperty.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace
{
using Place = std::array<double, 3>;

// Returns a place near what the camera looks at, from which points are counted before they become floats.
// It depends on the camera alone, so that all ranks find the same one. It lies on a lattice with a spacing of
// 32 to 256 times half the height of the view. So it seldom changes, and a float holds points in view, up to
// 2^8 such halves away, to 2^-16 of a half: some hundredths of a pixel. The focal point counts only where it
// is between the clipping planes: it may be anywhere on the line of sight.
Place PlaceInView(vtkCamera* camera)
{
  Place position;
  Place place;
  camera->GetPosition(position.data());
  camera->GetFocalPoint(place.data());
  const double distance =
    std::clamp(camera->GetDistance(), camera->GetClippingRange()[0], camera->GetClippingRange()[1]);
  const double half = camera->GetParallelProjection()
    ? camera->GetParallelScale()
    : distance * std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
  int exponent = 0;
  std::frexp(32.0 * half, &exponent);
  const double spacing = std::ldexp(1.0, 3 * static_cast<int>(std::ceil(exponent / 3.0)));
  const double along = distance / camera->GetDistance();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    place[axis] = position[axis] + along * (place[axis] - position[axis]);
    place[axis] = spacing * std::round(place[axis] / spacing);
    if (!std::isfinite(place[axis]))
    {
      return Place{};
    }
  }
  return place;
}

// Returns where a place is in the coordinates of the data that an actor moves.
Place InData(const Place& place, vtkActor* actor)
{
  if (actor->vtkProp3D::GetIsIdentity())
  {
    return place;
  }
  vtkNew<vtkMatrix4x4> inverse;
  vtkMatrix4x4::Invert(actor->GetMatrix(), inverse);
  double moved[4] = { place[0], place[1], place[2], 1.0 };
  inverse->MultiplyPoint(moved, moved);
  return { moved[0], moved[1], moved[2] };
}

vtkSmartPointer<vtkPolyData> CountedFrom(const Place& place, vtkPolyData* data)
{
  auto moved = vtkSmartPointer<vtkPolyData>::New();
  moved->ShallowCopy(data);
  if (vtkPoints* points = data->GetPoints())
  {
    vtkNew<vtkPoints> differences;
    differences->SetDataTypeToFloat();
    differences->SetNumberOfPoints(points->GetNumberOfPoints());
    for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
    {
      double point[3];
      points->GetPoint(i, point);
      differences->SetPoint(i, point[0] - place[0], point[1] - place[1], point[2] - place[2]);
    }
    moved->SetPoints(differences);
  }
  return moved;
}

// Returns the data with points counted from a place, block by block.
vtkSmartPointer<vtkDataObject> CountedFrom(const Place& place, vtkDataObject* data)
{
  auto* blocks = vtkCompositeDataSet::SafeDownCast(data);
  auto* single = vtkPolyData::SafeDownCast(data);
  if (place == Place{} || !(blocks || single))
  {
    return data;
  }
  if (single)
  {
    return CountedFrom(place, single);
  }
  auto moved = vtk::TakeSmartPointer(blocks->NewInstance());
  moved->CopyStructure(blocks);
  auto each = vtk::TakeSmartPointer(blocks->NewIterator());
  for (each->InitTraversal(); !each->IsDoneWithTraversal(); each->GoToNextItem())
  {
    moved->SetDataSet(each, CountedFrom(place, each->GetCurrentDataObject()));
  }
  return moved;
}

// Returns true if points are in units of the box, which no radius is.
bool AreScaled(vtkFieldData* fields)
{
  vtkAbstractArray* kind = fields ? fields->GetAbstractArray("Coordinates") : nullptr;
  return kind && kind->GetNumberOfValues() == 1 && kind->GetVariantValue(0).ToString() == "Scaled";
}

// Returns true if data have no radii of this name, or none in the unit of their points. Without a name all radii are 1.
bool LackRadii(vtkDataObject* data, const char* name)
{
  if (!name || !name[0])
  {
    return false;
  }
  for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets(data))
  {
    if (block->GetPointData()->HasArray(name) && !AreScaled(block->GetFieldData()))
    {
      return false;
    }
  }
  return true;
}

// A mapper that is right where floats are not: vtkOpenGLPointGaussianMapper makes floats of coordinates as they
// are, here they are first counted from a place in view, in doubles. The actor adds the place again. It draws points with the
// property's size where there are no radii, as it does for a factor of 0.
class GrainsMapper : public vtkOpenGLPointGaussianMapper
{
public:
  static GrainsMapper* New();
  vtkTypeMacro(GrainsMapper, vtkOpenGLPointGaussianMapper);

  using Superclass::SetInputDataObject;
  void SetInputDataObject(int port, vtkDataObject* data) override
  {
    if (data != this->Grains || (data && this->Time < data->GetMTime()))
    {
      this->Grains = data;
      this->Time = data ? data->GetMTime() : 0;
      this->Superclass::SetInputDataObject(port, CountedFrom(this->From, data));
    }
  }

  void Render(vtkRenderer* renderer, vtkActor* actor) override
  {
    const bool dots = LackRadii(this->Grains, this->ScaleArray);
    if (dots != this->AreDots)
    {
      this->AreDots = dots;
      this->Modified();
    }
    const Place place = InData(PlaceInView(renderer->GetActiveCamera()), actor);
    if (place != this->From)
    {
      this->From = place;
      this->Superclass::SetInputDataObject(0, CountedFrom(place, this->Grains));
    }
    this->Superclass::Render(renderer, actor);
  }

  double GetScaleFactor() override
  {
    return this->AreDots ? 0.0 : this->Superclass::GetScaleFactor();
  }

  vtkDataObject* GetGrains() { return this->Grains; } // where they are
  const Place& GetFrom() { return this->From; }

private:
  vtkSmartPointer<vtkDataObject> Grains;
  vtkMTimeType Time = 0;
  Place From{};
  bool AreDots = false;
};
vtkStandardNewMacro(GrainsMapper);

// From each sphere, not from all centres and the largest radius: how the points are dealt to ranks
// must not show in where the camera is put.
void AddSpheres(double (&bounds)[6], vtkActor* actor, vtkDataSet* data)
{
  auto* mapper = vtkPointGaussianMapper::SafeDownCast(actor->GetMapper());
  const char* name = mapper->GetScaleArray();
  vtkDataArray* radii = name ? data->GetPointData()->GetArray(name) : nullptr;
  const double factor = LackRadii(data, name) ? 0.0 : mapper->GetScaleFactor();
  vtkMatrix4x4* matrix = actor->vtkProp3D::GetIsIdentity() ? nullptr : actor->GetMatrix();
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
  const bool scaled = AreScaled(fields);
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

// Returns true if a rank has points of the data. All ranks must ask.
bool AnyRankHasPoints(vtkDataObject* data)
{
  vtkIdType here = 0;
  for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets(data))
  {
    here += block->GetNumberOfPoints();
  }
  vtkIdType most = here;
  if (auto* ranks = vtkMultiProcessController::GetGlobalController())
  {
    ranks->AllReduce(&here, &most, 1, vtkCommunicator::MAX_OP);
  }
  return most > 0;
}

// An actor whose bounds hold the spheres, not their centres alone: cullers and IceT go by them. It draws what its
// mapper counts from a place where that belongs.
class GrainsActor : public vtkOpenGLActor
{
public:
  static GrainsActor* New();
  vtkTypeMacro(GrainsActor, vtkOpenGLActor);

  double* GetBounds() override
  {
    return this->Drawn.Of(this, this->GetGrainsMapper()->GetGrains());
  }

  double* GetBoundsOf(vtkDataObject* data) { return this->Read.Of(this, data); }

  int GetIsIdentity() override
  {
    return this->GetGrainsMapper()->GetFrom() == Place{} && this->Superclass::GetIsIdentity();
  }

  // The matrices of OpenGL: they are applied to rows.
  void GetKeyMatrices(vtkMatrix4x4*& matrix, vtkMatrix3x3*& normals) override
  {
    this->Superclass::GetKeyMatrices(matrix, normals);
    const Place& from = this->GetGrainsMapper()->GetFrom();
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
  GrainsMapper* GetGrainsMapper() { return static_cast<GrainsMapper*>(this->Mapper); }

  vtkNew<vtkMatrix4x4> FromPlace;
  SphereBounds Drawn; // what this rank draws
  SphereBounds Read;  // what was read on this rank, before it is sent anywhere
};
vtkStandardNewMacro(GrainsActor);
}

vtkStandardNewMacro(vtkGranularGrainsRepresentation);

vtkGranularGrainsRepresentation::vtkGranularGrainsRepresentation()
{
  this->Mapper = vtkSmartPointer<GrainsMapper>::New();
  this->Actor = vtkSmartPointer<GrainsActor>::New();
  this->Actor->SetMapper(this->Mapper);
  // From VTK 9.4 on spheres are projected as if they were small, which would stretch one beside the camera over all
  // of the picture. So the mapper leaves out every sphere whose centre is outside the view by a third. Only those more
  // than 60 degrees off the line of sight have to go; where the shader has no such line, nothing is replaced.
  const std::string outside = "posDC.x < -1.3*posDC.w || posDC.x > 1.3*posDC.w || posDC.y < "
                              "-1.3*posDC.w || posDC.y > 1.3*posDC.w";
  this->Actor->GetShaderProperty()->AddVertexShaderReplacement("if (" + outside + ")", true,
    "if ((" + outside + ") && cameraParallel == 0 && length(posVC.xy) > -1.7 * posVC.z)", false);
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
    vtkBoundingBox box;
    if (!AnyRankHasPoints(this->ProcessedData))
    {
      for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets(this->ProcessedData))
      {
        AddBox(box, this->Actor, block->GetFieldData());
      }
    }
    double boxBounds[6];
    box.GetBounds(boxBounds);
    vtkPVRenderView::SetGeometryBounds(inInfo, this, box.IsValid() ? boxBounds : bounds);
    if (!this->IsTranslucent())
    {
      outInfo->Remove(vtkPVRenderView::NEED_ORDERED_COMPOSITING());
    }
  }
  return 1;
}
