// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularEulerInput_h
#define vtkGranularEulerInput_h

#include "granular/euler/cells.h"
#include "granular/parallel/communicator.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <vector>

class vtkDataObject;
class vtkPointSet;

namespace vtkGranularPrivate
{
/**
 * Cells one after the other along x, by the place of the first one in a grid that processes share.
 */
struct CellRun
{
  vtkTypeInt64 Z = 0;
  vtkTypeInt64 Y = 0;
  vtkTypeInt64 X = 0;
  vtkTypeInt64 Count = 0;
};

/**
 * The cells that a process has.
 */
struct EulerInput
{
  granular::EulerCells Cells;
  std::vector<CellRun> Runs;           ///< of a grid; else none: cells are as they come
  vtkSmartPointer<vtkPointSet> Points; ///< with the field data that the input has
};

/**
 * Takes points with point arrays, or a vtkImageData or vtkRectilinearGrid with cell arrays, each cell at its middle, or a composite of
 * such, one after the other. Absolute: what was subtracted from the points is added. Duplicates of
 * ghosts are left out. Throws UnsupportedError of other data, and where an array is missing.
 */
EulerInput ReadCells(vtkDataObject* input);

/**
 * All cells, on rank 0: of a grid z slowest, then y, then x; else in the order of the ranks. Collective.
 */
granular::EulerCells GatherCells(EulerInput&& own, granular::Communicator& ranks);
}

#endif
