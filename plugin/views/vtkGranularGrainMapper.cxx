// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularGrainMapper.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkFloatArray.h"
#include "vtkGranularGrainBlocks.h"
#include "vtkGranularGrainFragments.h"
#include "vtkGranularGrainShaders.h"
#include "vtkGranularGrainShapes.h"
#include "vtkGranularSuperquadrics.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLCamera.h"
#include "vtkOpenGLHelper.h"
#include "vtkOpenGLIndexBufferObject.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLState.h"
#include "vtkOpenGLVertexBufferObjectGroup.h"
#include "vtkPlane.h"
#include "vtkPlaneCollection.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkProperty.h"
#include "vtkRenderer.h"
#include "vtkShader.h"
#include "vtkShaderProgram.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace
{
constexpr int MostClips = 6; // as VTK has it

void Replace(vtkShader* shader, const char* mark, const std::string& text)
{
  std::string source = shader->GetSource();
  vtkShaderProgram::Substitute(source, mark, text);
  shader->SetSource(source);
}

template <typename Array>
vtkSmartPointer<Array> MakeArray(vtkIdType tuples, int components)
{
  auto made = vtkSmartPointer<Array>::New();
  made->SetNumberOfComponents(components);
  made->SetNumberOfTuples(tuples);
  return made;
}

// Splits a number into a float and what that lacks, in steps of 1/254 of its last place from 1 to 255. The programs put them together.
void Split(double number, float& high, unsigned char& low)
{
  high = static_cast<float>(number);
  const auto power = std::bit_cast<float>(std::bit_cast<std::uint32_t>(high) & 0x7F800000U); // of 2
  const double part = std::ldexp(number - high, 24) / power;
  low = static_cast<unsigned char>(std::isfinite(part) ? 128.5 + 127.0 * part : 128.0);
}

// Splits what tells of one particle.
void Split(
  const double* numbers, int count, vtkIdType i, vtkFloatArray* high, vtkUnsignedCharArray* low)
{
  float* highs = high->GetPointer(count * i);
  unsigned char* lows = low->GetPointer(4 * i);
  for (int k = 0; k < count; ++k)
  {
    Split(numbers[k], highs[k], lows[k]);
  }
}

// Returns an array, or nullptr.
vtkDataArray* Find(vtkPolyData* data, const char* name)
{
  return name ? data->GetPointData()->GetArray(name) : nullptr;
}

// The radii of the data: those of an array, 0 without it; 1 if none is named.
struct Radii
{
  Radii(vtkPolyData* data, const char* name)
    : Given(Find(data, name))
    , Same(name && name[0] ? 0.0 : 1.0)
  {
  }

  double Get(vtkIdType i) const
  {
    const double radius = this->Given ? this->Given->GetComponent(i, 0) : this->Same;
    return std::isfinite(radius) ? radius : 0.0;
  }

  vtkDataArray* Given;
  double Same;
};

constexpr unsigned int ViewportOfOpenGL = 0x0BA2; // the header of GL_VIEWPORT depends on VTK

// Sets numbers: floats, and what they lack. VTK keeps the names' addresses.
template <std::size_t N>
void SetNumbers(vtkShaderProgram* program, const char* name, const char* lowName,
  const std::array<double, N>& numbers)
{
  const auto set = [&](const char* each, float(&values)[N])
  {
    if constexpr (N == 9)
    {
      program->SetUniformMatrix3x3(each, values);
    }
    else if constexpr (N == 3)
    {
      program->SetUniform3f(each, values);
    }
    else
    {
      program->SetUniform2f(each, values);
    }
  };
  float high[N];
  float low[N];
  for (std::size_t i = 0; i < N; ++i)
  {
    high[i] = static_cast<float>(numbers[i]);
    low[i] = static_cast<float>(numbers[i] - high[i]);
  }
  set(name, high);
  set(lowName, low);
}

// The way from the coordinates of an actor's data, counted from a place, to the picture. Nothing of it is a float before it is a number of
// the picture or of the distance from the place.
class GrainView
{
public:
  GrainView(vtkRenderer* renderer, vtkActor* actor, const std::array<double, 3>& place)
    : Camera(static_cast<vtkOpenGLCamera*>(renderer->GetActiveCamera()))
    , Scale(std::cbrt(std::abs(actor->GetMatrix()->Determinant())))
    , Near(static_cast<float>(-this->Camera->GetClippingRange()[0]))
  {
    vtkMatrix4x4* worldToCamera;
    vtkMatrix3x3* normals;
    vtkMatrix4x4* worldToPicture;
    this->Camera->GetKeyMatrices(
      renderer, worldToCamera, normals, this->CameraToPicture, worldToPicture);
    vtkMatrix4x4::Multiply4x4(
      this->Camera->GetModelViewTransformMatrix(), actor->GetMatrix(), this->ToCamera);
    double moved[4] = { place[0], place[1], place[2], 1.0 };
    this->ToCamera->MultiplyPoint(moved, moved);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->ToCamera->SetElement(axis, 3, moved[axis]);
    }
  }

  vtkGranularHiddenGrains::View ForHidden() const
  {
    vtkGranularHiddenGrains::View made;
    for (int i = 0; i < 3; ++i)
    {
      for (int k = 0; k < 4; ++k)
      {
        made.ToCamera[i][k] = static_cast<float>(this->ToCamera->GetElement(i, k));
      }
    }
    made.Parallel = this->IsParallel();
    for (int i = 0; i < 2; ++i)
    {
      made.Scale[i] = static_cast<float>(this->Zoom(i));
      made.Middle[i] = static_cast<float>(this->Middle(i));
    }
    made.Near = this->Near;
    made.Radius = static_cast<float>(this->Scale);
    return made;
  }

  // Sets what the programs of vtkGranularGrainShaders.h need.
  void Set(vtkShaderProgram* program, vtkRenderer* renderer) const
  {
    std::array<double, 9> toCamera; // column by column
    for (int i = 0; i < 9; ++i)
    {
      toCamera[static_cast<std::size_t>(i)] = this->ToCamera->GetElement(i % 3, i / 3);
    }
    SetNumbers(program, "dataVC", "dataVCLow", toCamera);
    const auto scale = static_cast<float>(this->Scale);
    const float scales[2] = { scale, static_cast<float>(this->Scale - scale) };
    program->SetUniform2f("scaleVC", scales);
    program->SetUniformi("cameraParallel", this->IsParallel() ? 1 : 0);
    program->SetUniformf("nearVC", this->Near);
    const vtkGranularHiddenGrains::View picture = this->ForHidden();
    const float toPicture[4] = { picture.Scale[0], picture.Scale[1], picture.Middle[0],
      picture.Middle[1] };
    program->SetUniform4f("pictureVC", toPicture);
    int viewport[4]; // also of passes that draw into pictures of their own
    static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow())
      ->GetState()
      ->vtkglGetIntegerv(ViewportOfOpenGL, viewport);
    std::array<double, 2> pixelSizes;
    std::array<double, 2> axisPixel;
    for (int i = 0; i < 2; ++i)
    {
      const auto axis = static_cast<std::size_t>(i);
      axisPixel[axis] = viewport[i] + 0.5 * viewport[i + 2] * (1.0 + this->Middle(i));
      pixelSizes[axis] = 2.0 / (viewport[i + 2] * this->Zoom(i));
    }
    SetNumbers(program, "axisPixel", "axisPixelLow", axisPixel);
    SetNumbers(program, "placeVC", "placeVCLow",
      std::array{ this->Place(0), this->Place(1), this->Place(2) });
    SetNumbers(program, "pixelVC", "pixelVCLow", pixelSizes);
    SetNumbers(program, "farVC", "farVCLow", this->FromFar());
  }

private:
  bool IsParallel() const { return this->Camera->GetParallelProjection() != 0; }

  // OpenGL's matrices are applied to rows.
  double Element(int row, int column) const
  {
    return this->CameraToPicture->GetElement(column, row);
  }

  // The picture, from -1 to 1, is Zoom x + Middle of a place at z = -1, or of any place if parallel.
  double Zoom(int axis) const { return this->Element(axis, axis); }

  double Middle(int axis) const
  {
    return this->IsParallel() ? this->Element(axis, 3) : -this->Element(axis, 2);
  }

  double Place(int axis) const { return this->ToCamera->GetElement(axis, 3); }

  // The picture's z, from -1 to 1, is (a z + b) / (c z + d), and the depth (1 + that) / 2. Returns z of the place from the far plane, where the
  // picture's z is 1, and the change of the depth with z there, times w = c z + d.
  std::array<double, 2> FromFar() const
  {
    const double a = this->Element(2, 2);
    const double b = this->Element(2, 3);
    const double c = this->Element(3, 2);
    const double d = this->Element(3, 3);
    const double z = (d - b) / (a - c);
    return { this->Place(2) - z, 0.5 * (a * d - b * c) / (c * z + d) };
  }

  vtkOpenGLCamera* Camera;
  vtkMatrix4x4* CameraToPicture;
  vtkNew<vtkMatrix4x4> ToCamera;
  double Scale; // of lengths
  float Near;   // z of the near plane
};
}

vtkStandardNewMacro(vtkGranularGrainMapper);

vtkGranularGrainMapper::Place vtkGranularGrainMapper::InData(const Place& place, vtkActor* actor)
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

void vtkGranularGrainMapper::Draw(
  vtkRenderer* renderer, vtkActor* actor, vtkGranularGrainBlocks* owner, const Place& from)
{
  if (this->CopyTime < owner->GetMTime())
  {
    const vtkSmartPointer<vtkPolyData> input = this->GetInput();
    this->vtkPolyDataMapper::ShallowCopy(owner);
    this->SetInputData(input);
    this->CopyTime.Modified();
  }
  this->Owner = owner;
  this->From = from;
  this->PopulateSelectionSettings = 0; // of all blocks together
  this->RenderPiece(renderer, actor);
  this->PopulateSelectionSettings = 1;
}

void vtkGranularGrainMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  if (renderer->GetSelector())
  {
    // off where points are selected; here they are surfaces, of which the nearest counts
    static_cast<vtkOpenGLRenderer*>(renderer)->GetState()->vtkglDepthMask(1);
  }
  if (!this->FindSeen(renderer, actor) && !this->HasAll)
  {
    this->Upload(renderer, nullptr);
  }
  this->Superclass::RenderPieceDraw(renderer, actor);
}

void vtkGranularGrainMapper::GetShaderTemplate(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->vtkOpenGLPolyDataMapper::GetShaderTemplate(shaders, renderer, actor);
  shaders[vtkShader::Vertex]->SetSource(vtkGranularGrainShaders::Vertex);
  shaders[vtkShader::Geometry]->SetSource(vtkGranularGrainShaders::Geometry);
}

void vtkGranularGrainMapper::ReplaceShaderValues(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  this->vtkOpenGLPolyDataMapper::ReplaceShaderValues(
    shaders, renderer, actor); // not that of VTK's spheres
  const int planes = this->CountClips();
  const std::string clips = planes > 0 ? "#define CLIPS " + std::to_string(planes) : "";
  for (const auto& [type, shader] : shaders)
  {
    Replace(shader, "//VTK::System::Dec", vtkGranularGrainShaders::Extensions);
    Replace(shader, "//GRANULAR::Shapes",
      vtkGranularGrainShaders::Reals +
        std::string(this->HaveShapes ? "#define HAVE_SHAPES\n" : "") + clips);
  }
}

void vtkGranularGrainMapper::ReplaceShaderPositionVC(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*)
{
  vtkShader* fragment = shaders[vtkShader::Fragment];
  std::string inputs = vtkGranularGrainShaders::FragmentInputs;
  if (this->HaveShapes)
  {
    using namespace vtkGranularGrainShaders;
    for (const char* part : { ShapeInputs, InFloats, Superquadrics, Meets, "#ifdef HAVE_DOUBLES",
           InDoubles, Superquadrics, "#endif\n" })
    {
      inputs += part;
    }
  }
  Replace(fragment, "//VTK::PositionVC::Dec", inputs);
  Replace(fragment, "//VTK::PositionVC::Impl", "vec4 vertexVC = vec4(0.0);\n");
}

void vtkGranularGrainMapper::ReplaceShaderNormal(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*)
{
  Replace(
    shaders[vtkShader::Fragment], "//VTK::Depth::Impl", vtkGranularGrainShaders::FragmentSurface);
}

void vtkGranularGrainMapper::ReplaceShaderClip(
  std::map<vtkShader::Type, vtkShader*>, vtkRenderer*, vtkActor*)
{
  // the surface is clipped where a ray meets it
}

void vtkGranularGrainMapper::SetCameraShaderParameters(
  vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor)
{
  GrainView(renderer, actor, this->From).Set(helper.Program, renderer);
  this->SetClips(helper.Program, renderer->GetActiveCamera()->GetModelViewTransformMatrix());
}

int vtkGranularGrainMapper::CountClips()
{
  vtkPlaneCollection* planes = this->GetClippingPlanes();
  return planes ? std::min(planes->GetNumberOfItems(), MostClips) : 0;
}

void vtkGranularGrainMapper::SetClips(vtkShaderProgram* program, vtkMatrix4x4* worldToCamera)
{
  vtkPlaneCollection* planes = this->GetClippingPlanes();
  const int clips = this->CountClips();
  vtkNew<vtkMatrix4x4> cameraToWorld;
  vtkMatrix4x4::Invert(worldToCamera, cameraToWorld);
  cameraToWorld->Transpose();
  float clip[MostClips][4] = {};
  for (int i = 0; i < clips; ++i)
  {
    const double* normal = planes->GetItem(i)->GetNormal();
    const double* origin = planes->GetItem(i)->GetOrigin();
    double plane[4] = { normal[0], normal[1], normal[2],
      -(normal[0] * origin[0] + normal[1] * origin[1] + normal[2] * origin[2]) };
    cameraToWorld->MultiplyPoint(plane, plane);
    std::transform(plane, plane + 4, clip[i], [](double each) { return static_cast<float>(each); });
  }
  if (clips > 0)
  {
    program->SetUniform4fv("clipVC", clips, clip);
  }
}

bool vtkGranularGrainMapper::GetNeedToRebuildBufferObjects(vtkRenderer*, vtkActor* actor)
{
  const vtkMTimeType changed = std::max({ this->GetMTime(), this->CurrentInput->GetMTime(),
    this->Owner->GetMTime(), actor->GetProperty()->GetMTime() });
  return this->VBOBuildTime < changed || this->Built != this->From;
}

void vtkGranularGrainMapper::BuildBufferObjects(vtkRenderer*, vtkActor* actor)
{
  vtkPolyData* data = this->CurrentInput;
  const vtkIdType count = data->GetNumberOfPoints();
  this->Values.clear();
  auto points = MakeArray<vtkFloatArray>(count, 3);
  auto radii = MakeArray<vtkFloatArray>(count, 1);
  auto lows = MakeArray<vtkUnsignedCharArray>(count, 4);
  const Radii given(data, this->Owner->GetScaleArray());
  const double factor = this->Growth * this->Owner->GetScaleFactor();
  for (vtkIdType i = 0; i < count; ++i)
  {
    Split(factor * given.Get(i), *radii->GetPointer(i), *lows->GetPointer(4 * i + 3));
    double place[3];
    data->GetPoint(i, place);
    std::transform(place, place + 3, this->From.begin(), place, std::minus<>());
    Split(place, 3, i, points, lows);
  }
  this->Inner = radii;
  this->BuildShapes(radii);
  this->Values["vertexMC"] = points;
  this->Values["radiusMC"] = radii;
  this->Values["lowMC"] = lows;
  this->BuildColors(actor);
  this->HasAll = false;
  this->Built = this->From;
  this->VBOBuildTime.Modified();
}

// Puts particles into the buffers, all or those that are seen.
void vtkGranularGrainMapper::Upload(
  vtkRenderer* renderer, const vtkGranularHiddenGrains::Seen* seen)
{
  for (const char* name : { "vertexMC", "lowMC", "radiusMC", "scalarColor", "axesMC", "axesLowMC",
         "turnMC", "turnLowMC", "powersMC" })
  {
    vtkSmartPointer<vtkDataArray> values = this->Values[name];
    if (values && seen)
    {
      values = vtk::TakeSmartPointer(values->NewInstance());
      values->SetNumberOfComponents(this->Values[name]->GetNumberOfComponents());
      values->SetNumberOfTuples(static_cast<vtkIdType>(seen->Grains.size()));
      const int size = values->GetNumberOfComponents() * values->GetDataTypeSize();
      const auto* from = static_cast<const char*>(this->Values[name]->GetVoidPointer(0));
      auto* to = static_cast<char*>(values->GetVoidPointer(0));
      for (const vtkIdType i : seen->Grains)
      {
        to = std::copy_n(from + size * i, size, to);
      }
    }
    this->VBOs->CacheDataArray(name, values, renderer, values ? values->GetDataType() : VTK_FLOAT);
  }
  vtkNew<vtkUnsignedCharArray> parts;
  parts->SetNumberOfComponents(4);
  parts->SetNumberOfTuples(
    seen ? static_cast<vtkIdType>(seen->Grains.size()) : this->CurrentInput->GetNumberOfPoints());
  auto* to = reinterpret_cast<std::array<unsigned char, 4>*>(parts->GetPointer(0));
  if (seen)
  {
    std::copy(seen->Parts.begin(), seen->Parts.end(), to);
  }
  else
  {
    std::fill_n(to, parts->GetNumberOfTuples(), std::array<unsigned char, 4>{ 0, 0, 255, 255 });
  }
  this->VBOs->CacheDataArray("partMC", parts, renderer, VTK_UNSIGNED_CHAR);
  this->VBOs->BuildAllVBOs(renderer);
  for (int i = PrimitiveStart; i < PrimitiveEnd; ++i)
  {
    this->Primitives[i].IBO->IndexCount = 0;
  }
  this->Primitives[PrimitiveTris].IBO->IndexCount =
    1; // the superclass draws the points, whatever the number
  this->HasAll = seen == nullptr;
}

// Puts the particles into the buffers that others do not hide. Returns false where all are to be drawn.
bool vtkGranularGrainMapper::FindSeen(vtkRenderer* renderer, vtkActor* actor)
{
  constexpr vtkIdType fewest = 10000; // fewer are drawn at once
  const vtkIdType count = this->CurrentInput->GetNumberOfPoints();
  if (count < fewest || renderer->GetSelector() || this->IsTranslucent ||
    actor->GetProperty()->GetOpacity() < 1.0 || this->CountClips() > 0)
  {
    return false;
  }
  vtkGranularHiddenGrains::Grains grains;
  grains.Points = static_cast<const float*>(this->Values["vertexMC"]->GetVoidPointer(0));
  grains.Outer = static_cast<const float*>(this->Values["radiusMC"]->GetVoidPointer(0));
  grains.Inner = this->Inner->GetPointer(0);
  grains.Count = count;
  const vtkGranularHiddenGrains::Seen& seen =
    this->Hidden.Find(GrainView(renderer, actor, this->From).ForHidden(), grains);
  if (2 * static_cast<vtkIdType>(seen.Grains.size()) > count)
  {
    return false;
  }
  this->Upload(renderer, &seen);
  return true;
}

// Loads the shapes, if there are any; the radii become those of spheres around them, for which floats are enough.
void vtkGranularGrainMapper::BuildShapes(vtkFloatArray* radii)
{
  const vtkGranularGrainShapes shapes(this->CurrentInput, this->Owner->GetShapeSizes());
  if (this->HaveShapes != shapes.Any())
  {
    this->HaveShapes = shapes.Any();
    this->Modified(); // another program
  }
  if (!shapes.Any())
  {
    return;
  }
  const vtkIdType count = radii->GetNumberOfTuples();
  auto axes = MakeArray<vtkFloatArray>(count, 3);
  auto turns = MakeArray<vtkFloatArray>(count, 4);
  auto axesLows = MakeArray<vtkUnsignedCharArray>(count, 4);
  auto turnLows = MakeArray<vtkUnsignedCharArray>(count, 4);
  auto powers = MakeArray<vtkFloatArray>(count, 2);
  auto inner = MakeArray<vtkFloatArray>(count, 1);
  const Radii given(this->CurrentInput, this->Owner->GetScaleArray());
  const double factor = this->Growth * this->Owner->GetScaleFactor();
  for (vtkIdType i = 0; i < count; ++i)
  {
    vtkGranularGrainShapes::Shape shape = shapes.Get(i, given.Get(i));
    std::for_each(shape.Axes.begin(), shape.Axes.end(), [&](double& axis) { axis *= factor; });
    Split(shape.Axes.data(), 3, i, axes, axesLows);
    axesLows->SetTypedComponent(i, 3, 128); // VTK wants a multiple of 4 bytes
    Split(shape.Turn.data(), 4, i, turns, turnLows);
    powers->SetTuple(i, shape.Powers.data());
    radii->SetValue(i, static_cast<float>(factor * shape.Outer));
    inner->SetValue(i, static_cast<float>(factor * shape.Inner));
  }
  this->Inner = inner;
  this->Values["axesMC"] = axes;
  this->Values["turnMC"] = turns;
  this->Values["axesLowMC"] = axesLows;
  this->Values["turnLowMC"] = turnLows;
  this->Values["powersMC"] = powers;
}

void vtkGranularGrainMapper::BuildColors(vtkActor* actor)
{
  vtkPolyData* data = this->CurrentInput;
  const vtkIdType count = data->GetNumberOfPoints();
  vtkDataArray* opacities = Find(data, this->Owner->GetOpacityArray());
  this->IsTranslucent = false;
  this->MapScalars(1.0);
  vtkUnsignedCharArray* mapped =
    this->Colors && this->Colors->GetNumberOfTuples() == count ? this->Colors : nullptr;
  if (!mapped && !opacities)
  {
    return;
  }
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(4);
  colors->SetNumberOfTuples(count);
  const double* plain = actor->GetProperty()->GetColor();
  for (vtkIdType i = 0; i < count; ++i)
  {
    for (int k = 0; k < 4; ++k)
    {
      const double color = k < 3 ? 255.0 * plain[k] : 255.0;
      colors->SetTypedComponent(i, k,
        mapped && k < mapped->GetNumberOfComponents() ? mapped->GetTypedComponent(i, k)
                                                      : static_cast<unsigned char>(color));
    }
    if (opacities)
    {
      const double opacity = opacities->GetComponent(i, 0);
      colors->SetTypedComponent(
        i, 3, static_cast<unsigned char>(255.0 * std::clamp(opacity, 0.0, 1.0)));
    }
    this->IsTranslucent = this->IsTranslucent || colors->GetTypedComponent(i, 3) < 255;
  }
  this->Values["scalarColor"] = colors;
}
