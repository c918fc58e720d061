// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularDecompositionAlgorithmInternals_h
#define vtkGranularDecompositionAlgorithmInternals_h

#include "vtkGranularDecompositionAlgorithm.h"

#include "private/decomposition/voxels.h"
#include "private/request/piece_request.h"
#include "private/request/processes.h"

#include "granular/decomposition/process_grid.h"

#include <array>
#include <vector>

/**
 * What source and filter share.
 */
struct vtkGranularDecompositionAlgorithm::Internals
{
  std::array<std::vector<double>, 3> Cuts;

  /**
   * The grid of the properties in a box.
   */
  granular::ProcessGrid MakeGrid(vtkGranularDecompositionAlgorithm* self,
    const granular::Vector3& lo, const granular::Vector3& hi) const;

  /**
   * The form of the properties, for a number of threads of this process.
   */
  vtkGranularPrivate::VoxelForm MakeForm(vtkGranularDecompositionAlgorithm* self);
};

#endif
