// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularGrainsRepresentation
 * @brief   Surfaces of particles: with depth and light, whole on any number of ranks, and right far from the origin.
 *
 * vtkGranularGrainMapper draws them. What comes from ParaView's Point Gaussian tells ParaView where the points are, not the particles.
 * Three things follow from that, and are put right here:
 *
 * - Under several ranks only the part of the picture that the points of a rank cover is taken from it, and a particle is cut off where it
 *   reaches beyond. Here the bounds hold the particles. That also keeps one in the picture whose centre has left it.
 * - The ranks' pictures are laid over one another in the order of the regions of space they stand for. Particles reach into other
 *   regions, where that order is wrong. Here each pixel is taken from the rank where it is nearest, as for surfaces, unless the
 *   particles are translucent: then the order of regions is the best there is.
 * - For that order points are sent from rank to rank. Here opaque particles stay where they were read.
 *
 * Coordinates are counted from a place in doubles before they become floats: the middle of the particles, or a place near the centre of
 * the view where this shows a small part of them. It depends on the data and the camera alone and seldom changes.
 *
 * A frame without particles, on any rank, has the bounds of the simulation box, which the field data BoxOrigin and
 * BoxVectors give: the first frame of most runs that insert particles is empty, and ParaView puts the camera where
 * the first frame wants it. Of scaled coordinates it is the unit cube.
 *
 * Particles without radii are drawn as points with the size of the property PointSize, and so are those with scaled
 * coordinates, which radii do not fit.
 *
 * While the user moves the camera over large data, when ParaView's settings ask for less detail, few particles are drawn: the same ones
 * in each frame, larger, so that all of them would fill the same volume.
 *
 * Made for radii without a transfer function, as the XML sets them.
 */

#ifndef vtkGranularGrainsRepresentation_h
#define vtkGranularGrainsRepresentation_h

#include "vtkGranularViewsModule.h" // For export macro
#include "vtkPointGaussianRepresentation.h"

class VTKGRANULARVIEWS_EXPORT vtkGranularGrainsRepresentation
  : public vtkPointGaussianRepresentation
{
public:
  static vtkGranularGrainsRepresentation* New();
  vtkTypeMacro(vtkGranularGrainsRepresentation, vtkPointGaussianRepresentation);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo) override;

  /**
   * Name of the point array of the radii, in the unit of the points. Where there is no such array,
   * points are drawn. Where the name is empty, all radii are 1. All are multiplied by the splat size.
   */
  void SetRadiusArray(const char* name);

  /**
   * A factor on all radii. The view looks for its clipping planes anew.
   */
  void SetSplatSize(double factor) override;

  /**
   * Sets the meaning of the sizes of shapes: 0, as the data say; 1, half axes; 2, diameters.
   */
  void SetShapeSizes(int sizes);

  /**
   * Name of the point array of the opacities, from 0 to 1; null or "None": all are as opaque as the property.
   */
  void SetOpacities(const char* name);

  ///@{
  /**
   * Sets the material of the particles, as vtkProperty has it.
   */
  void SetAmbient(double part);
  void SetDiffuse(double part);
  void SetSpecular(double brightness);
  using Superclass::SetSpecularPower;
  ///@}

protected:
  vtkGranularGrainsRepresentation();
  ~vtkGranularGrainsRepresentation() override;

private:
  vtkGranularGrainsRepresentation(const vtkGranularGrainsRepresentation&) = delete;
  void operator=(const vtkGranularGrainsRepresentation&) = delete;

  bool IsTranslucent();

  vtkIdType Grains = 0; // on all ranks where data are read
  double MostWhileMoving = 1e5;
};

#endif
