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
 * The shared parts of the decomposition source and filter.
 */
struct vtkGranularDecompositionAlgorithm::Internals
{
  std::array<std::vector<double>, 3> Cuts;

  /**
   * Returns the grid that the properties define in a box.
   */
  granular::ProcessGrid MakeGrid(vtkGranularDecompositionAlgorithm* self,
    const granular::Vector3& lo, const granular::Vector3& hi) const;
};

#endif
