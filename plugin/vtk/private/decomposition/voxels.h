// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularVoxels_h
#define vtkGranularVoxels_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/geometry/box.h"
#include "granular/grid/subdomains.h"

class vtkUnstructuredGrid;

namespace vtkGranularPrivate
{
/**
 * Options of voxels.
 */
struct VoxelForm
{
  granular::Vector3 Origin = {}; ///< subtracted
  int Threads = 1;
};

/**
 * Fills the output with subdomains as voxels with the cell arrays nlocal (int64) and proc (int32), as far as they are
 * known. Throws Cancelled.
 */
void FillVoxels(vtkUnstructuredGrid* output, const granular::Decomposition& decomposition,
  const VoxelForm& form, granular::Progress& progress);

/**
 * Returns the subdomains that cells represent: voxels, in VTK's order or the mirrored one of LIGGGHTS-INL, or
 * axis-aligned hexahedra, with the arrays nlocal and proc or procID, if present. Positions are absolute: a subtracted
 * origin is added, and scaled points are multiplied by the box. Duplicate ghosts are left out. Throws Error;
 * UnsupportedError for other cells.
 */
granular::Decomposition ReadVoxels(vtkUnstructuredGrid* input, granular::Notices& notices);
}

#endif
