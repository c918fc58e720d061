// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularGrainView_h
#define vtkGranularGrainView_h

#include "vtkGranularHiddenGrains.h"
#include "vtkNew.h"

#include <array>

class vtkActor;
class vtkMatrix4x4;
class vtkOpenGLCamera;
class vtkRenderer;
class vtkShaderProgram;

/**
 * The way from the coordinates of an actor's data, counted from a place, to the picture. Nothing of it is a float before it is a number of
 * the picture or of the distance from the place.
 */
class vtkGranularGrainView
{
public:
  vtkGranularGrainView(vtkRenderer* renderer, vtkActor* actor, const std::array<double, 3>& place);

  vtkGranularHiddenGrains::View ForHidden() const;

  /// Sets what the programs of vtkGranularGrainShaders.h need.
  void Set(vtkShaderProgram* program, vtkRenderer* renderer) const;

private:
  bool IsParallel() const;
  double Element(int row, int column) const;
  double Zoom(int axis) const;
  double Middle(int axis) const;
  double Place(int axis) const;
  std::array<double, 2> FromFar() const;

  vtkOpenGLCamera* Camera;
  vtkMatrix4x4* CameraToPicture;
  vtkNew<vtkMatrix4x4> ToCamera;
  double Scale; // of lengths
  float Near;   // z of the near plane
};

#endif
