// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_euler_regular_grids_h
#define granular_euler_regular_grids_h

#include "granular/common/error.h"
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
/// ave/euler), or those of processes that divide a box by planes (`parallel yes`), x fastest; processes that go on with the
/// same grid may be one. Edges of cells are found from the distances of centres, within what six decimals allow, or single
/// precision or six digits where all centres have no more; neighbours share their faces to the bit. Where a grid is one cell
/// thick, that is what the grids beside it leave, or their distance; where there is none the mean edge along the other axes,
/// with a notice. Faces of a rectilinear grid count as they are. Throws UnsupportedError that names the first cell that is in
/// none.
std::vector<RegularGrid> find_regular_grids(const EulerFrame& frame, Notices& notices);
}
#endif
