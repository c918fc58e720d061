// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularGrainMapper
 * @brief   Draws the surfaces of particles by rays.
 *
 * Each pixel has the depth, the normal and the light of the surface that its ray meets. A particle is one vertex of the buffers, with
 * 20 bytes for its centre and its radius, and a square in the picture that covers all that can be seen of it.
 *
 * The inside of a particle is seen where the near plane or a clipping plane cuts it open. Of a translucent particle the side towards the
 * camera is seen.
 *
 * Particles are spheres, or superquadrics (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 = 1 in the particle's own axes, where the data have
 * the arrays of vtkGranularGrainShapes.
 */

#ifndef vtkGranularGrainMapper_h
#define vtkGranularGrainMapper_h

#include "vtkGranularHiddenGrains.h" // For a member
#include "vtkOpenGLSphereMapper.h"
#include "vtkSmartPointer.h" // For members

#include <array>  // For places
#include <map>    // For values
#include <string> // For names

class vtkDataArray;
class vtkFloatArray;
class vtkGranularGrainBlocks;

class vtkGranularGrainMapper : public vtkOpenGLSphereMapper
{
public:
  static vtkGranularGrainMapper* New();
  vtkTypeMacro(vtkGranularGrainMapper, vtkOpenGLSphereMapper);

  using Place = std::array<double, 3>;

  /**
   * Returns where a place is in the coordinates of the data that an actor moves.
   */
  static Place InData(const Place& place, vtkActor* actor);

  /**
   * Draws the input with the radii, shapes, colours and opacities that another mapper tells. Coordinates are counted from a place before
   * they become floats.
   */
  void Draw(
    vtkRenderer* renderer, vtkActor* actor, vtkGranularGrainBlocks* owner, const Place& from);

  ///@{
  /**
   * A factor on all sizes, beside that of the other mapper; 1 by default.
   */
  vtkSetMacro(Growth, double);
  vtkGetMacro(Growth, double);
  ///@}

  ///@{
  /**
   * The flat index of the block of a composite dataset that the input is; 1 for a single dataset.
   */
  vtkSetMacro(FlatIndex, unsigned int);
  vtkGetMacro(FlatIndex, unsigned int);
  ///@}

protected:
  vtkGranularGrainMapper() = default;
  ~vtkGranularGrainMapper() override = default;

  void GetShaderTemplate(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderValues(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderNormal(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderClip(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderPositionVC(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void SetCameraShaderParameters(
    vtkOpenGLHelper& helper, vtkRenderer* renderer, vtkActor* actor) override;
  bool GetNeedToRebuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  void BuildBufferObjects(vtkRenderer* renderer, vtkActor* actor) override;
  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;

private:
  vtkGranularGrainMapper(const vtkGranularGrainMapper&) = delete;
  void operator=(const vtkGranularGrainMapper&) = delete;

  void SetClips(vtkShaderProgram* program, vtkMatrix4x4* worldToCamera);
  void BuildShapes(vtkFloatArray* radii);
  void BuildColors(vtkActor* actor);
  void Upload(vtkRenderer* renderer, const vtkGranularHiddenGrains::Seen* seen);
  int CountClips();
  bool FindSeen(vtkRenderer* renderer, vtkActor* actor);

  unsigned int FlatIndex = 1;
  double Growth = 1.0;
  vtkGranularGrainBlocks* Owner = nullptr; // while it draws
  Place From{};                            // of the next picture
  Place Built{};                           // of the values
  bool HaveShapes = false;
  std::map<std::string, vtkSmartPointer<vtkDataArray>>
    Values; // of each particle, by the names that the programs have for them
  vtkSmartPointer<vtkFloatArray> Inner; // radii of spheres inside the particles
  vtkGranularHiddenGrains Hidden;
  bool HasAll = false; // all particles are in the buffers
  bool IsTranslucent = false;
  vtkTimeStamp CopyTime; // of what the owner tells
};

#endif
