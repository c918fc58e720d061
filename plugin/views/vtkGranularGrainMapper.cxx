// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularGrainMapper.h"

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
#include <cmath>
#include <functional>
#include <string>

namespace
{
constexpr int MostClips = 6;                      // as VTK has it
constexpr unsigned int ViewportOfOpenGL = 0x0BA2; // the header of GL_VIEWPORT depends on VTK

void Replace(vtkShader* shader, const char* mark, const std::string& text)
{
  std::string source = shader->GetSource();
  vtkShaderProgram::Substitute(source, mark, text);
  shader->SetSource(source);
}

vtkSmartPointer<vtkFloatArray> MakeFloats(vtkIdType tuples, int components)
{
  auto made = vtkSmartPointer<vtkFloatArray>::New();
  made->SetNumberOfComponents(components);
  made->SetNumberOfTuples(tuples);
  return made;
}

// Returns an array, or nullptr.
vtkDataArray* Find(vtkPolyData* data, const char* name)
{
  return name ? data->GetPointData()->GetArray(name) : nullptr;
}

// The way from the buffers, which are counted from a place, to the picture.
struct View
{
  View(vtkRenderer* renderer, vtkActor* actor, const std::array<double, 3>& from)
    : Camera(static_cast<vtkOpenGLCamera*>(renderer->GetActiveCamera()))
    , Scale(static_cast<float>(std::cbrt(std::abs(actor->GetMatrix()->Determinant()))))
    , Near(static_cast<float>(-this->Camera->GetClippingRange()[0]))
  {
    vtkMatrix4x4* worldToCamera;
    vtkMatrix3x3* normals;
    vtkMatrix4x4* worldToPicture;
    this->Camera->GetKeyMatrices(
      renderer, worldToCamera, normals, this->CameraToPicture, worldToPicture);
    vtkMatrix4x4::Multiply4x4(
      this->Camera->GetModelViewTransformMatrix(), actor->GetMatrix(), this->ToCamera);
    double place[4] = { from[0], from[1], from[2], 1.0 };
    this->ToCamera->MultiplyPoint(place, place);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->ToCamera->SetElement(axis, 3, place[axis]); // in doubles until here
    }
  }

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

  bool IsParallel() const { return this->Camera->GetParallelProjection() != 0; }
  double Place(int axis) const { return this->ToCamera->GetElement(axis, 3); }
  bool IsInFront() const { return this->Place(2) < 0.5 * this->Near; }

  // Returns where the line from the camera to the place meets z = -1; 0 if it is the camera.
  double Tangent(int axis) const
  {
    if (this->IsParallel())
    {
      return this->Place(axis);
    }
    return this->IsInFront() ? -this->Place(axis) / this->Place(2) : 0.0;
  }

  // The picture's z, from -1 to 1, is (a z + b) / (c z + d), and the depth (1 + that) / 2. Returns z of the place from where the picture's
  // z is a given one, and the change of the depth with z there, times w = c z + d.
  std::array<float, 2> DepthFrom(double pictures) const
  {
    const double a = this->Element(2, 2);
    const double b = this->Element(2, 3);
    const double c = this->Element(3, 2);
    const double d = this->Element(3, 3);
    const double z = (pictures * d - b) / (a - pictures * c);
    return { static_cast<float>(this->Place(2) - z),
      static_cast<float>(0.5 * (a * d - b * c) / (c * z + d)) };
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
    made.Radius = this->Scale;
    return made;
  }

  vtkOpenGLCamera* Camera;
  vtkMatrix4x4* CameraToPicture;
  vtkNew<vtkMatrix4x4> ToCamera;
  float Scale; // of lengths
  float Near;  // z of the near plane
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

// Returns the coordinates of the points, all or those that are seen.
vtkSmartPointer<vtkFloatArray> vtkGranularGrainMapper::Count(
  const Counting& counting, vtkDataArray* points, const vtkGranularHiddenGrains::Seen* seen)
{
  const vtkIdType count =
    seen ? static_cast<vtkIdType>(seen->Grains.size()) : points->GetNumberOfTuples();
  auto made = MakeFloats(count, 3);
  float* to = made->GetPointer(0);
  for (vtkIdType i = 0; i < count; ++i)
  {
    double at[3];
    points->GetTuple(seen ? seen->Grains[static_cast<std::size_t>(i)] : i, at);
    std::transform(at, at + 3, counting.From.begin(), at, std::minus<>());
    for (const double* axis = counting.Axes.data(); axis != counting.Axes.data() + 9; axis += 3)
    {
      *to++ = static_cast<float>(axis[0] * at[0] + axis[1] * at[1] + axis[2] * at[2]);
    }
  }
  return made;
}

// Close to a camera in perspective the units of a depth buffer are parts of the distance, so there coordinates are those of the camera, in
// doubles until they are floats; else they are counted from a given place in the middle of the particles, and serve all pictures.
vtkGranularGrainMapper::Counting vtkGranularGrainMapper::ChooseCounting(
  vtkRenderer* renderer, vtkActor* actor, const Place& middle)
{
  const View view(renderer, actor, middle);
  vtkCamera* camera = view.Camera;
  const double* range = camera->GetClippingRange();
  Counting chosen{ middle };
  if (!view.IsParallel() && !(view.IsInFront() && 3.0 * range[0] > range[1]))
  {
    camera->GetPosition(chosen.From.data());
    chosen.From = InData(chosen.From, actor);
    for (int i = 0; i < 9; ++i)
    {
      chosen.Axes[static_cast<std::size_t>(i)] = view.ToCamera->GetElement(i / 3, i % 3);
    }
  }
  return chosen;
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
  const Counting counting = ChooseCounting(renderer, actor, this->From);
  const bool isNew = this->Counted != counting;
  this->Counted = counting;
  if (!this->FindSeen(renderer, actor) && (!this->HasAll || isNew))
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
    Replace(
      shader, "//GRANULAR::Shapes", (this->HaveShapes ? "#define HAVE_SHAPES\n" : "") + clips);
  }
}

void vtkGranularGrainMapper::ReplaceShaderPositionVC(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer*, vtkActor*)
{
  vtkShader* fragment = shaders[vtkShader::Fragment];
  Replace(fragment, "//VTK::PositionVC::Dec",
    std::string(vtkGranularGrainShaders::FragmentInputs) + vtkGranularGrainShaders::Superquadrics);
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
  const View view(renderer, actor, this->Counted.From);
  vtkShaderProgram* program = helper.Program;
  const bool isOfCamera = this->Counted.Axes != Counting().Axes;
  float toCamera[2][9]; // the buffers' coordinates and the data's, column by column
  for (int i = 0; i < 9; ++i)
  {
    toCamera[1][i] = static_cast<float>(view.ToCamera->GetElement(i % 3, i / 3));
    toCamera[0][i] = isOfCamera ? (i % 4 == 0 ? 1.0F : 0.0F) : toCamera[1][i];
  }
  program->SetUniformMatrix3x3("bufferVC", toCamera[0]);
  program->SetUniformMatrix3x3("dataVC", toCamera[1]);
  program->SetUniformf("scaleVC", view.Scale);
  program->SetUniformi("cameraParallel", view.IsParallel() ? 1 : 0);
  program->SetUniformf("nearVC", view.Near);
  const vtkGranularHiddenGrains::View picture = view.ForHidden();
  const float toPicture[4] = { picture.Scale[0], picture.Scale[1], picture.Middle[0],
    picture.Middle[1] };
  program->SetUniform4f("pictureVC", toPicture);
  int viewport[4]; // also of passes that draw into pictures of their own
  static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow())
    ->GetState()
    ->vtkglGetIntegerv(ViewportOfOpenGL, viewport);
  float place[3];
  float pixelSizes[2];
  float tangents[2];
  float pixels[4];
  for (int i = 0; i < 3; ++i)
  {
    place[i] = static_cast<float>(view.Place(i));
  }
  for (int i = 0; i < 2; ++i)
  {
    const double tangent = view.Tangent(i);
    const double pixel =
      viewport[i] + 0.5 * viewport[i + 2] * (1.0 + view.Zoom(i) * tangent + view.Middle(i));
    tangents[i] = static_cast<float>(tangent);
    pixels[i] = std::floor(static_cast<float>(pixel));
    pixels[i + 2] = static_cast<float>(pixel - pixels[i]);
    pixelSizes[i] = static_cast<float>(2.0 / (viewport[i + 2] * view.Zoom(i)));
  }
  program->SetUniform3f("placeVC", place);
  program->SetUniform2f("placeTangent", tangents);
  program->SetUniform4f("placePixel", pixels);
  program->SetUniform2f("pixelVC", pixelSizes);

  program->SetUniform2f("middleVC", view.DepthFrom(0.0).data());
  program->SetUniform2f("farVC", view.DepthFrom(1.0).data());
  this->SetClips(program, view.Camera->GetModelViewTransformMatrix());
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
  this->Values["vertexMC"] = Count({ this->From }, data->GetPoints()->GetData(), nullptr);
  auto radii = MakeFloats(count, 1);
  const char* name = this->Owner->GetScaleArray();
  vtkDataArray* given = Find(data, name);
  const double same = name && name[0] ? 0.0 : 1.0; // where there is no such array
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double radius =
      this->Growth * this->Owner->GetScaleFactor() * (given ? given->GetComponent(i, 0) : same);
    radii->SetValue(i, static_cast<float>(std::isfinite(radius) ? radius : 0.0));
  }
  this->Inner = radii;
  this->BuildShapes(radii);
  this->Values["radiusMC"] = radii;
  this->BuildColors(actor);
  this->HasAll = false;
  this->Built = this->From;
  this->VBOBuildTime.Modified();
}

// Puts particles into the buffers, all or those that are seen.
void vtkGranularGrainMapper::Upload(
  vtkRenderer* renderer, const vtkGranularHiddenGrains::Seen* seen)
{
  for (const char* name : { "vertexMC", "radiusMC", "scalarColor", "axesMC", "turnMC", "powersMC" })
  {
    vtkSmartPointer<vtkDataArray> values = this->Values[name];
    if (name == std::string("vertexMC"))
    {
      values = Count(this->Counted, this->CurrentInput->GetPoints()->GetData(), seen);
    }
    else if (values && seen)
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
    this->VBOs->CacheDataArray(
      name, values, renderer, std::string(name) == "scalarColor" ? VTK_UNSIGNED_CHAR : VTK_FLOAT);
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
    this->Hidden.Find(View(renderer, actor, this->From).ForHidden(), grains);
  if (2 * static_cast<vtkIdType>(seen.Grains.size()) > count)
  {
    return false;
  }
  this->Upload(renderer, &seen);
  return true;
}

// Loads the shapes, if there are any; the radii become those of spheres around them.
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
  auto axes = MakeFloats(count, 3);
  auto turns = MakeFloats(count, 4);
  auto powers = MakeFloats(count, 2);
  auto inner = MakeFloats(count, 1);
  const double factor = this->Growth * this->Owner->GetScaleFactor();
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double radius = factor > 0.0 ? radii->GetValue(i) / factor : 0.0;
    const vtkGranularGrainShapes::Shape shape = shapes.Get(i, radius);
    for (int k = 0; k < 3; ++k)
    {
      axes->SetTypedComponent(
        i, k, static_cast<float>(factor * shape.Axes[static_cast<std::size_t>(k)]));
    }
    turns->SetTuple(i, shape.Turn.data());
    powers->SetTuple(i, shape.Powers.data());
    radii->SetValue(i, static_cast<float>(factor * shape.Outer));
    inner->SetValue(i, static_cast<float>(factor * shape.Inner));
  }
  this->Inner = inner;
  this->Values["axesMC"] = axes;
  this->Values["turnMC"] = turns;
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
