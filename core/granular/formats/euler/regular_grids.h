// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_euler_regular_grids_h
#define granular_formats_euler_regular_grids_h

#include "granular/common/error.h"
#include "granular/formats/euler/euler_file.h"
#include "granular/grid/euler_grid.h"

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

/// Returns the regular grids that consecutive cells of a frame form: one (`parallel no` of fix ave/euler), or those of ranks
/// that divide a box by planes (`parallel yes`), x fastest; ranks that continue the same grid may be one. The distances of
/// centres give the edges of cells, within six decimals, or within single precision or six digits if all centres have no
/// more; neighbours share their faces to the bit. The thickness of a grid one cell thick comes from the grids beside it, or
/// from their distance; without such grids it is the mean edge along the other axes, with a notice. Faces of a rectilinear
/// grid count unchanged. Throws UnsupportedError that names the first cell outside any grid.
std::vector<RegularGrid> find_regular_grids(const EulerFrame& frame, Notices& notices);
}
#endif
