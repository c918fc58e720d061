// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularGrainBlocks.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkGranularGrainMapper.h"
#include "vtkGranularGrainShapes.h"
#include "vtkHardwareSelector.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

namespace
{
using Place = vtkGranularGrainBlocks::Place;

constexpr double MostSizes = 64.0; // of the particles together, in halves of the view's height

// Returns the distance of what the camera looks at, between the clipping planes: the focal point may be anywhere on the line of sight.
double DistanceInView(vtkCamera* camera)
{
  return std::clamp(
    camera->GetDistance(), camera->GetClippingRange()[0], camera->GetClippingRange()[1]);
}

// Returns half the height of the view there.
double HalfHeight(vtkCamera* camera)
{
  return camera->GetParallelProjection()
    ? camera->GetParallelScale()
    : DistanceInView(camera) * std::tan(0.5 * vtkMath::RadiansFromDegrees(camera->GetViewAngle()));
}

// Returns a place near what the camera looks at, from which points are counted before they become floats.
// It depends on the camera alone, so that all ranks find the same one. It lies on a lattice with a spacing of
// 32 to 256 times half the height of the view. So it seldom changes, and a float holds points in view, up to
// 2^8 such halves away, to 2^-16 of a half: some hundredths of a pixel. (With what it lacks, to 2^-24.)
Place PlaceInView(vtkCamera* camera)
{
  Place position;
  Place place;
  camera->GetPosition(position.data());
  camera->GetFocalPoint(place.data());
  const double distance = DistanceInView(camera);
  const double half = HalfHeight(camera);
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

// Spreads ids that follow each other: the high half of the product with the golden ratio.
std::uint64_t HashOf(std::uint64_t id)
{
  return id * 0x9e3779b97f4a7c15U >> 32U;
}

// Returns about one point of so many, without cells: those that a hash of the point array `id` chooses, so that they are the same
// ones in each frame and on any number of ranks; without ids, a hash of the number of the point.
vtkSmartPointer<vtkPolyData> ChooseFew(vtkPolyData* data, vtkIdType every)
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
}

vtkStandardNewMacro(vtkGranularGrainBlocks);

bool vtkGranularGrainBlocks::AreScaled(vtkFieldData* fields)
{
  vtkAbstractArray* kind = fields ? fields->GetAbstractArray("Coordinates") : nullptr;
  return kind && kind->GetNumberOfValues() == 1 && kind->GetVariantValue(0).ToString() == "Scaled";
}

bool vtkGranularGrainBlocks::LackRadii(vtkDataObject* data, const char* name)
{
  if (!name || !name[0])
  {
    return false;
  }
  for (vtkDataSet* block : vtkCompositeDataSet::GetDataSets(data))
  {
    if ((block->GetPointData()->HasArray(name) ||
          vtkGranularGrainShapes(block, vtkGranularGrainShapes::AsTheDataSay).Any()) &&
      !AreScaled(block->GetFieldData()))
    {
      return false;
    }
  }
  return true;
}

void vtkGranularGrainBlocks::SetInputDataObject(int port, vtkDataObject* data)
{
  if (data != this->Grains || (data && this->Time < data->GetMTime()))
  {
    this->Grains = data;
    this->Time = data ? data->GetMTime() : 0;
    this->Superclass::SetInputDataObject(port, CountedFrom(this->From, data));
    this->SetBlocks();
  }
}

void vtkGranularGrainBlocks::Render(vtkRenderer* renderer, vtkActor* actor)
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

double vtkGranularGrainBlocks::GetScaleFactor()
{
  return this->AreDots ? 0.0 : this->Superclass::GetScaleFactor();
}

void vtkGranularGrainBlocks::ReleaseGraphicsResources(vtkWindow* window)
{
  for (const Mappers* mappers : { &this->Blocks, &this->FewBlocks })
  {
    for (const auto& block : *mappers)
    {
      block->ReleaseGraphicsResources(window);
    }
  }
  this->Superclass::ReleaseGraphicsResources(window);
}

void vtkGranularGrainBlocks::ProcessSelectorPixelBuffers(
  vtkHardwareSelector* selector, std::vector<unsigned int>& pixels, vtkProp* prop)
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

void vtkGranularGrainBlocks::Add(Mappers& mappers, vtkPolyData* data, unsigned int index)
{
  if (data && data->GetNumberOfPoints() > 0)
  {
    mappers.push_back(vtkSmartPointer<vtkGranularGrainMapper>::New());
    mappers.back()->SetInputData(data);
    mappers.back()->SetFlatIndex(index);
  }
}

void vtkGranularGrainBlocks::SetBlocks()
{
  this->Blocks.clear();
  this->FewBlocks.clear();
  if (auto* blocks = vtkCompositeDataSet::SafeDownCast(this->Grains))
  {
    auto each = vtk::TakeSmartPointer(blocks->NewIterator());
    for (each->InitTraversal(); !each->IsDoneWithTraversal(); each->GoToNextItem())
    {
      Add(this->Blocks, vtkPolyData::SafeDownCast(each->GetCurrentDataObject()),
        each->GetCurrentFlatIndex());
    }
  }
  else
  {
    Add(this->Blocks, vtkPolyData::SafeDownCast(this->Grains), 1);
  }
  this->Centres = CentreBounds(this->Grains);
}

// Returns the blocks to draw: all particles, or few of them that take as much room.
const vtkGranularGrainBlocks::Mappers& vtkGranularGrainBlocks::ChooseBlocks()
{
  if (this->Every <= 1)
  {
    return this->Blocks;
  }
  if (this->FewBlocks.empty() || this->FewEvery != this->Every)
  {
    this->FewBlocks.clear();
    for (const auto& block : this->Blocks)
    {
      Add(this->FewBlocks, ChooseFew(block->GetInput(), this->Every), block->GetFlatIndex());
    }
    this->FewEvery = this->Every;
  }
  for (const auto& block : this->FewBlocks)
  {
    block->SetGrowth(std::cbrt(static_cast<double>(this->Every)));
  }
  return this->FewBlocks;
}

// Depths are as exact as the coordinates: the middle of the particles serves all pictures but those of a small part.
vtkGranularGrainBlocks::Place vtkGranularGrainBlocks::ChoosePlace(
  vtkCamera* camera, vtkActor* actor)
{
  Place middle{};
  if (!this->AreDots && this->Centres.IsValid() &&
    this->Centres.GetDiagonalLength() < MostSizes * HalfHeight(camera))
  {
    this->Centres.GetCenter(middle.data());
    return middle;
  }
  return vtkGranularGrainMapper::InData(PlaceInView(camera), actor);
}

void vtkGranularGrainBlocks::DrawBlocks(vtkRenderer* renderer, vtkActor* actor, const Place& place)
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
  for (const auto& block : this->ChooseBlocks())
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
