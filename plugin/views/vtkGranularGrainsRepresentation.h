// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkGranularGrainsRepresentation
 * @brief   Point Gaussian for particles: whole on any number of ranks, and right far from the origin.
 *
 * vtkPointGaussianRepresentation tells ParaView where the points are, not the spheres. Three things
 * follow from that, and are put right here:
 *
 * - Under several ranks only the part of the picture that the points of a rank cover is taken from
 *   it, and a sphere is cut off where it reaches beyond. Here the bounds hold the spheres. That also
 *   keeps a sphere in the picture whose centre has left it.
 * - The ranks' pictures are laid over one another in the order of the regions of space they stand
 *   for. Spheres reach into other regions, where that order is wrong. Here each pixel is taken from
 *   the rank where it is nearest, as for surfaces, unless the particles are translucent: then the order
 *   of regions is the best there is.
 * - For that order points are sent from rank to rank. Here opaque particles stay where they were read.
 *
 * Its mapper makes floats of the coordinates as they are: spheres of 5e-4 at 1024 lie on a lattice of a quarter of
 * their radius, and at 2^20 nothing is seen of them. Here a place near the centre of the view is subtracted in doubles first. It depends on
 * the camera alone and seldom changes; near the origin it is the origin, and points are passed on as they are.
 *
 * A frame without particles, on any rank, has the bounds of the simulation box, which the field data BoxOrigin and
 * BoxVectors give: the first frame of most runs that insert particles is empty, and ParaView puts the camera where
 * the first frame wants it. Of scaled coordinates it is the unit cube.
 *
 * Particles without radii are drawn as points with the size of the property PointSize, and so are those with scaled
 * coordinates, which radii do not fit.
 *
 * Made for the preset Sphere and radii without a transfer function, as the XML sets them.
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

protected:
  vtkGranularGrainsRepresentation();
  ~vtkGranularGrainsRepresentation() override;

private:
  vtkGranularGrainsRepresentation(const vtkGranularGrainsRepresentation&) = delete;
  void operator=(const vtkGranularGrainsRepresentation&) = delete;

  bool IsTranslucent();
};

#endif
