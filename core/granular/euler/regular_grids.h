// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_euler_regular_grids_h
#define granular_euler_regular_grids_h

#include "granular/base/error.h"
#include "granular/euler/euler_file.h"
#include "granular/euler/euler_grid.h"

#include <cstdint>
#include <vector>

namespace granular
{
/// Cells of a frame that form a regular grid: cell [first + (k ny + j) nx + i] of the frame is cell i j k of the grid.
struct RegularGrid
{
  EulerGrid grid;
  std::int64_t first = 0;
};

/// The regular grids that the cells of a frame form, as they follow one another in it: one (`parallel no` of fix
/// ave/euler), or one for each process (`parallel yes`), x fastest. Edges of cells are found from the distances of centres, within
/// what six decimals allow; where a grid is one cell thick, from other grids of the frame along that axis, else from its other axes,
/// with a notice. Throws UnsupportedError that names the first cell that is in none.
std::vector<RegularGrid> find_regular_grids(const EulerFrame& frame, Notices& notices);
}
#endif
