// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularGrainBlocks
 * @brief   Draws particles, block by block.
 *
 * A vtkGranularGrainMapper draws each block. Where there are no radii, the superclass draws points with the property's size, as it does
 * for a factor of 0. It makes floats of coordinates as they are: they are first counted from a place, in doubles.
 */

#ifndef vtkGranularGrainBlocks_h
#define vtkGranularGrainBlocks_h

#include "vtkBoundingBox.h" // For a member
#include "vtkOpenGLPointGaussianMapper.h"
#include "vtkSmartPointer.h" // For members

#include <array>  // For places
#include <vector> // For lists

class vtkCamera;
class vtkFieldData;
class vtkGranularGrainMapper;

class vtkGranularGrainBlocks : public vtkOpenGLPointGaussianMapper
{
public:
  static vtkGranularGrainBlocks* New();
  vtkTypeMacro(vtkGranularGrainBlocks, vtkOpenGLPointGaussianMapper);

  using Place = std::array<double, 3>;

  /**
   * Returns true if points are in units of the box, which no radius is.
   */
  static bool AreScaled(vtkFieldData* fields);

  /**
   * Returns true if data have no radii of this name and no shapes, or none in the unit of their points. Without a name all radii are 1.
   */
  static bool LackRadii(vtkDataObject* data, const char* name);

  using Superclass::SetInputDataObject;
  void SetInputDataObject(int port, vtkDataObject* data) override;
  void Render(vtkRenderer* renderer, vtkActor* actor) override;
  void ReleaseGraphicsResources(vtkWindow* window) override;
  void ProcessSelectorPixelBuffers(
    vtkHardwareSelector* selector, std::vector<unsigned int>& pixels, vtkProp* prop) override;

  /**
   * Returns the factor on the radii, which is 0 where points are drawn.
   */
  double GetScaleFactor() override;

  /**
   * Returns the factor on the radii that was set.
   */
  double GetGivenFactor() { return this->Superclass::GetScaleFactor(); }

  ///@{
  /**
   * Meaning of the sizes of shapes: see vtkGranularGrainShapes.
   */
  vtkSetMacro(ShapeSizes, int);
  vtkGetMacro(ShapeSizes, int);
  ///@}

  /**
   * Draws one of so many particles, larger, from the next picture on; all of them for 1.
   */
  void SetEvery(vtkIdType every) { this->Every = every; }

  /**
   * Returns the particles where they are.
   */
  vtkDataObject* GetGrains() { return this->Grains; }

  /**
   * Returns the place that points without radii are counted from.
   */
  const Place& GetDotsFrom() { return this->From; }

protected:
  vtkGranularGrainBlocks() = default;
  ~vtkGranularGrainBlocks() override = default;

private:
  vtkGranularGrainBlocks(const vtkGranularGrainBlocks&) = delete;
  void operator=(const vtkGranularGrainBlocks&) = delete;

  using Mappers = std::vector<vtkSmartPointer<vtkGranularGrainMapper>>;

  static void Add(Mappers& mappers, vtkPolyData* data, unsigned int index);
  void SetBlocks();
  const Mappers& ChooseBlocks();
  Place ChoosePlace(vtkCamera* camera, vtkActor* actor);
  void DrawBlocks(vtkRenderer* renderer, vtkActor* actor, const Place& place);

  vtkSmartPointer<vtkDataObject> Grains;
  Mappers Blocks;
  Mappers FewBlocks; // made when they are first drawn
  vtkIdType Every = 1;
  vtkIdType FewEvery = 1; // of the few blocks
  int ShapeSizes = 0;
  vtkBoundingBox Centres;
  vtkMTimeType Time = 0;
  Place From{}; // of dots
  bool AreDots = false;
};

#endif
