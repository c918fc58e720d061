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
#include "vtkGranularGrainMapper.h"
#include "vtkGranularPlaceInView.h"
#include "vtkHardwareSelector.h"
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
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

namespace
{
using namespace vtkGranularPlaceInView;

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
    if ((block->GetPointData()->HasArray(name) || vtkGranularGrainMapper::GetShapes(block)) &&
      !AreScaled(block->GetFieldData()))
    {
      return false;
    }
  }
  return true;
}

// Returns the box around the centres of particles.
vtkBoundingBox CentreBounds(vtkDataObject* data)
{
  vtkBoundingBox bounds;
  for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets(data))
  {
    bounds.AddBounds(block->GetBounds());
  }
  return bounds;
}

// A mapper that draws the surfaces of particles. Where there are no radii, the superclass draws points with the property's size, as it
// does for a factor of 0. It makes floats of coordinates as they are: they are first counted from a place, in doubles.
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
      this->SetBlocks();
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
    const Place place = this->ChoosePlace(renderer->GetActiveCamera(), actor);
    if (!dots)
    {
      this->DrawBlocks(renderer, actor, place);
      return;
    }
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

  double GetGivenFactor() { return this->Superclass::GetScaleFactor(); } // of others than dots

  void ReleaseGraphicsResources(vtkWindow* window) override
  {
    for (const auto& block : this->Blocks)
    {
      block->ReleaseGraphicsResources(window);
    }
    this->Superclass::ReleaseGraphicsResources(window);
  }

  void ProcessSelectorPixelBuffers(
    vtkHardwareSelector* selector, std::vector<unsigned int>& pixels, vtkProp* prop) override
  {
    if (this->AreDots)
    {
      this->Superclass::ProcessSelectorPixelBuffers(selector, pixels, prop);
      return;
    }
    const unsigned char* indices =
      selector->GetRawPixelBuffer(vtkHardwareSelector::COMPOSITE_INDEX_PASS);
    for (const auto& block : this->Blocks)
    {
      std::vector<unsigned int> own;
      std::copy_if(pixels.begin(), pixels.end(), std::back_inserter(own),
        [&](unsigned int pixel)
        {
          const unsigned int index = !indices ? 0
                                              : indices[pixel] | indices[pixel + 1] << 8 |
              static_cast<unsigned int>(indices[pixel + 2]) << 16;
          return indices && index == block->GetFlatIndex() + 1;
        });
      if (!own.empty())
      {
        block->ProcessSelectorPixelBuffers(selector, own, prop);
      }
    }
  }

  vtkDataObject* GetGrains() { return this->Grains; } // where they are
  const Place& GetDotsFrom() { return this->From; }

private:
  void SetBlocks()
  {
    this->Blocks.clear();
    const auto add = [this](vtkPolyData* data, unsigned int index)
    {
      if (data && data->GetNumberOfPoints() > 0)
      {
        this->Blocks.push_back(vtkSmartPointer<vtkGranularGrainMapper>::New());
        this->Blocks.back()->SetInputData(data);
        this->Blocks.back()->SetFlatIndex(index);
      }
    };
    if (auto* blocks = vtkCompositeDataSet::SafeDownCast(this->Grains))
    {
      auto each = vtk::TakeSmartPointer(blocks->NewIterator());
      for (each->InitTraversal(); !each->IsDoneWithTraversal(); each->GoToNextItem())
      {
        add(vtkPolyData::SafeDownCast(each->GetCurrentDataObject()), each->GetCurrentFlatIndex());
      }
    }
    else
    {
      add(vtkPolyData::SafeDownCast(this->Grains), 1);
    }
    this->Centres = CentreBounds(this->Grains);
  }

  // Depths are as exact as the coordinates: the middle of the particles serves all pictures but those of a small part.
  Place ChoosePlace(vtkCamera* camera, vtkActor* actor)
  {
    Place middle{};
    if (!this->AreDots && this->Centres.IsValid() &&
      this->Centres.GetDiagonalLength() < MostSizes * HalfHeight(camera))
    {
      this->Centres.GetCenter(middle.data());
      return middle;
    }
    return InData(PlaceInView(camera), actor);
  }

  void DrawBlocks(vtkRenderer* renderer, vtkActor* actor, const Place& place)
  {
    if (renderer->GetRenderWindow()->CheckAbortStatus())
    {
      return;
    }
    vtkHardwareSelector* selector = renderer->GetSelector();
    if (selector)
    {
      selector->BeginRenderProp();
    }
    for (const auto& block : this->Blocks)
    {
      if (selector && selector->GetCurrentPass() == vtkHardwareSelector::COMPOSITE_INDEX_PASS)
      {
        selector->RenderCompositeIndex(block->GetFlatIndex());
      }
      block->Draw(renderer, actor, this, place);
    }
    if (selector)
    {
      selector->EndRenderProp();
    }
    this->UpdateProgress(1.0);
  }

  vtkSmartPointer<vtkDataObject> Grains;
  std::vector<vtkSmartPointer<vtkGranularGrainMapper>> Blocks;
  vtkBoundingBox Centres;
  vtkMTimeType Time = 0;
  Place From{}; // of dots
  bool AreDots = false;
};
vtkStandardNewMacro(GrainsMapper);

// From each sphere, not from all centres and the largest radius: how the points are dealt to ranks
// must not show in where the camera is put.
void AddSpheres(double (&bounds)[6], vtkActor* actor, vtkDataSet* data)
{
  auto* mapper = static_cast<GrainsMapper*>(actor->GetMapper());
  const char* name = mapper->GetScaleArray();
  vtkDataArray* radii = name ? data->GetPointData()->GetArray(name) : nullptr;
  const double factor = LackRadii(data, name) ? 0.0 : mapper->GetGivenFactor();
  vtkDataArray* shapes = vtkGranularGrainMapper::GetShapes(data);
  const double half = vtkGranularGrainMapper::GetShapeFactor(data);
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
    if (shapes)
    {
      const double* axes = shapes->GetTuple3(i);
      radius = std::max(radius, half * vtkMath::Norm(axes)); // of a box around it
    }
    radius *= factor * scale;
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
    return this->GetGrainsMapper()->GetDotsFrom() == Place{} && this->Superclass::GetIsIdentity();
  }

  // The matrices of OpenGL: they are applied to rows.
  void GetKeyMatrices(vtkMatrix4x4*& matrix, vtkMatrix3x3*& normals) override
  {
    this->Superclass::GetKeyMatrices(matrix, normals);
    const Place& from = this->GetGrainsMapper()->GetDotsFrom();
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

void vtkGranularGrainsRepresentation::SetSplatSize(double factor)
{
  if (factor != static_cast<GrainsMapper*>(this->Mapper.Get())->GetGivenFactor())
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

void vtkGranularGrainsRepresentation::SetSpecularPower(double sharpness)
{
  this->Actor->GetProperty()->SetSpecularPower(sharpness);
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
