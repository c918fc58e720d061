// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGranularGrainView.h"

#include "vtkActor.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLCamera.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkRenderer.h"
#include "vtkShaderProgram.h"

#include <cmath>
#include <cstddef>

namespace
{
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
}

vtkGranularGrainView::vtkGranularGrainView(
  vtkRenderer* renderer, vtkActor* actor, const std::array<double, 3>& place)
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

bool vtkGranularGrainView::IsParallel() const
{
  return this->Camera->GetParallelProjection() != 0;
}

// OpenGL's matrices are applied to rows.
double vtkGranularGrainView::Element(int row, int column) const
{
  return this->CameraToPicture->GetElement(column, row);
}

// The picture, from -1 to 1, is Zoom x + Middle of a place at z = -1, or of any place if parallel.
double vtkGranularGrainView::Zoom(int axis) const
{
  return this->Element(axis, axis);
}

double vtkGranularGrainView::Middle(int axis) const
{
  return this->IsParallel() ? this->Element(axis, 3) : -this->Element(axis, 2);
}

double vtkGranularGrainView::Place(int axis) const
{
  return this->ToCamera->GetElement(axis, 3);
}

// The picture's z, from -1 to 1, is (a z + b) / (c z + d), and the depth (1 + that) / 2. Returns z of the place from the far plane, where the
// picture's z is 1, and the change of the depth with z there, times w = c z + d.
std::array<double, 2> vtkGranularGrainView::FromFar() const
{
  const double a = this->Element(2, 2);
  const double b = this->Element(2, 3);
  const double c = this->Element(3, 2);
  const double d = this->Element(3, 3);
  const double z = (d - b) / (a - c);
  return { this->Place(2) - z, 0.5 * (a * d - b * c) / (c * z + d) };
}

vtkGranularHiddenGrains::View vtkGranularGrainView::ForHidden() const
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

void vtkGranularGrainView::Set(vtkShaderProgram* program, vtkRenderer* renderer) const
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
  SetNumbers(
    program, "placeVC", "placeVCLow", std::array{ this->Place(0), this->Place(1), this->Place(2) });
  SetNumbers(program, "pixelVC", "pixelVCLow", pixelSizes);
  SetNumbers(program, "farVC", "farVCLow", this->FromFar());
}
