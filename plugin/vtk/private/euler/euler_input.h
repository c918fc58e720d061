// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularEulerInput_h
#define vtkGranularEulerInput_h

#include "granular/euler/cells.h"
#include "granular/parallel/communicator.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkDataObject;
class vtkPointSet;

namespace vtkGranularPrivate
{
/**
 * Consecutive cells along x, identified by the place of the first one in a grid that ranks share.
 */
struct CellRun
{
  std::array<std::int64_t, 3> Place = {}; ///< along z, y and x
  std::int64_t Count = 0;
  std::int64_t First = 0; ///< number of the first one among all that are gathered
};

/**
 * The cells of a rank.
 */
struct EulerInput
{
  granular::EulerCells Cells;
  std::vector<CellRun> Runs;           ///< of a grid; else none: cells are as they come
  vtkSmartPointer<vtkPointSet> Points; ///< with the field data that the input has
};

/**
 * Reads points with point arrays, or a vtkImageData or vtkRectilinearGrid with cell arrays, where each cell counts at
 * its centre, or a composite of such data. Positions are absolute: a subtracted origin is added. Duplicate ghosts are
 * left out. Throws UnsupportedError for other data, and if an array is missing.
 */
EulerInput ReadCells(vtkDataObject* input);

/**
 * Returns all cells on rank 0: of a grid z slowest, then y, then x; otherwise in the order of the ranks. Collective.
 */
granular::EulerCells GatherCells(EulerInput&& own, granular::Communicator& ranks);
}

#endif
