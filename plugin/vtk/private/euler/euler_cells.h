// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularEulerCells_h
#define vtkGranularEulerCells_h

#include "granular/formats/euler/euler_file.h"
#include "granular/geometry/box.h"
#include "granular/grid/cells.h"
#include "granular/grid/euler_grid.h"

#include "vtkType.h"

#include <array>

class vtkDataSetAttributes;
class vtkImageData;
class vtkInformation;
class vtkPolyData;
class vtkTable;

namespace vtkGranularPrivate
{
/**
 * An extent of cells as VTK counts them, by the points at their faces: from extent[0] to extent[1] along x, and so on.
 * Empty if a first index is not below its last.
 */
using CellExtent = std::array<int, 6>;

/**
 * Returns the extent of all cells of a grid. Throws LimitError if VTK cannot count them.
 */
CellExtent ExtentOf(const granular::EulerGrid& grid);

/**
 * Announces the extent of an image. AskedExtent() returns the part that the pipeline requests.
 */
void OfferExtent(vtkInformation* output, const CellExtent& whole);

/**
 * Returns the cells that are requested for an output. After an error VTK may still request cells of an earlier whole;
 * the result is then the piece of the current one.
 */
CellExtent AskedExtent(vtkInformation* output, const CellExtent& whole);

/**
 * Fills the output with cells [begin, end) of a frame as points minus the origin, each with a vertex, and point arrays
 * of doubles.
 */
void FillPoints(vtkPolyData* output, const granular::EulerFrame& frame, vtkTypeInt64 begin,
  vtkTypeInt64 end, const granular::Vector3& pointOrigin);

/**
 * Adds the arrays of the first entries of a frame, or of `count` from another on.
 */
void AddArrays(vtkDataSetAttributes* data, const granular::EulerFrame& frame, vtkIdType count,
  vtkTypeInt64 begin = 0);

/**
 * Fills the table with cells [begin, end) of a frame, a row for each: `position`, the coordinate of the centre along an axis, and
 * the arrays.
 */
void FillTable(vtkTable* output, const granular::EulerFrame& frame, vtkTypeInt64 begin,
  vtkTypeInt64 end, int axis);

/**
 * The cells of a grid that a frame has: those of an extent, x fastest, from cell First of the frame on.
 */
struct HeldCells
{
  CellExtent Extent = {};
  vtkTypeInt64 First = 0;
};

/**
 * Fills the image with cells of a grid minus the origin, with cell arrays of doubles: those of an extent, all of which
 * the frame must have. An empty extent gives an empty image.
 */
void FillImage(vtkImageData* output, const granular::EulerGrid& grid, const CellExtent& extent,
  const granular::EulerFrame& frame, const HeldCells& held, const granular::Vector3& pointOrigin);
}

#endif
