// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularEulerCells_h
#define vtkGranularEulerCells_h

#include "granular/euler/cells.h"
#include "granular/euler/euler_file.h"
#include "granular/euler/euler_grid.h"
#include "granular/geometry/box.h"

#include "vtkType.h"

#include <array>

class vtkImageData;
class vtkInformation;
class vtkPolyData;

namespace vtkGranularPrivate
{
/**
 * Cells of a grid as VTK counts them, by the points at their faces: from extent[0] to extent[1] along x, and so on.
 * None where a first one is not below its last.
 */
using CellExtent = std::array<int, 6>;

/**
 * All cells of a grid. Throws LimitError where VTK cannot count them.
 */
CellExtent ExtentOf(const granular::EulerGrid& grid);

/**
 * Says what cells an image will have. AskedExtent() answers for whatever the pipeline asks.
 */
void OfferExtent(vtkInformation* output, const CellExtent& whole);

/**
 * The cells of a whole that an output is asked for. After an error VTK may still ask for those of a whole that there was:
 * then it is the piece of this one.
 */
CellExtent AskedExtent(vtkInformation* output, const CellExtent& whole);

/**
 * Cells as a file would have them, under its names: v_avg, volumefraction, ... Takes their memory.
 */
granular::EulerFrame MakeFrame(granular::EulerCells&& cells);

/**
 * Cells [begin, end) of a frame as points less the origin, each with a vertex, and point arrays of doubles.
 */
void FillPoints(vtkPolyData* output, const granular::EulerFrame& frame, vtkTypeInt64 begin,
  vtkTypeInt64 end, const granular::Vector3& pointOrigin);

/**
 * Which cells of a grid a frame has: those of an extent, x fastest, from cell First of the frame on.
 */
struct HeldCells
{
  CellExtent Extent = {};
  vtkTypeInt64 First = 0;
};

/**
 * Cells of a grid less the origin, with cell arrays of doubles: those of an extent, all of which the frame has. An extent
 * without cells makes an empty image.
 */
void FillImage(vtkImageData* output, const granular::EulerGrid& grid, const CellExtent& extent,
  const granular::EulerFrame& frame, const HeldCells& held, const granular::Vector3& pointOrigin);
}

#endif
