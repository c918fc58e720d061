// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_euler_cell_weights_h
#define granular_euler_cell_weights_h

#include "granular/kernels/kernel.h"
#include "granular/kernels/smooth_cells.h"

#include <cstdint>

namespace granular
{
/// The division of a particle among cells.
enum class CellWeights : std::uint8_t
{
  Centre,  ///< the whole particle in the cell of its centre, as in LIGGGHTS
  Overlap, ///< each cell has the volume of the particle inside it
  Kernel   ///< each cell has what a smoothing kernel around its centre gives: see SmoothCells
};

/// Ways to divide particles and contacts.
struct WeightOptions
{
  CellWeights weights = CellWeights::Overlap;
  bool short_cuts = true; ///< see SphereCells
  KernelShape kernel = KernelShape::Gaussian;
  double width = 0; ///< of the kernel, above 0
  KernelBounds bounds = KernelBounds::None;
};
}
#endif
