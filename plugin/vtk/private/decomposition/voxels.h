// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularVoxels_h
#define vtkGranularVoxels_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/decomposition/subdomains.h"
#include "granular/geometry/box.h"

class vtkUnstructuredGrid;

namespace vtkGranularPrivate
{
/**
 * How voxels are to be.
 */
struct VoxelForm
{
  granular::Vector3 Origin = {}; ///< subtracted
  bool SharedCorners = false;
  int Threads = 1;
};

/**
 * Subdomains as voxels with the cell arrays nlocal (int64) and proc (int32), as far as they are known. Throws Cancelled.
 */
void FillVoxels(vtkUnstructuredGrid* output, const granular::Decomposition& decomposition,
  const VoxelForm& form, granular::Progress& progress);

/**
 * The subdomains that cells are: voxels, in the right order or the mirrored one of LIGGGHTS-INL, or hexahedra,
 * along the axes; with the arrays nlocal and proc or procID, as far as they are there. Absolute: what was subtracted
 * from the points is added, scaled points are multiplied by the box. Duplicates of ghosts are left out. Throws
 * Error; UnsupportedError of other cells.
 */
granular::Decomposition ReadVoxels(vtkUnstructuredGrid* input, granular::Notices& notices);
}

#endif
