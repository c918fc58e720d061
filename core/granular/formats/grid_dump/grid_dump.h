// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_grid_dump_grid_dump_h
#define granular_formats_grid_dump_grid_dump_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/frames/file_format.h"
#include "granular/frames/run_index.h"
#include "granular/grid/cells.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Texts of `dump grid` of LAMMPS, for a RunIndex: frames like those of other dumps, with ITEM: GRID SIZE and a row for each cell.
const FileFormat& grid_format() noexcept;

/// Returns true if the first bytes of a file tell of such a grid. Returns false, and never throws, for unreadable files.
bool is_grid_file(const std::string& path) noexcept;

/// Decodes a frame, with the arrays that `wanted` accepts by name, as doubles; those of text are left out with a notice. Cells lie x
/// fastest: rows are put in the order of a column `id`, which must count from 1; without it they are taken as they are, with a notice, for
/// processes write their cells one after the other. Cells of a box that is not tilted have faces. Throws Error with path and line;
/// Cancelled.
EulerFrame read_grid(const std::vector<FramePiece>& pieces,
  const std::function<bool(std::string_view)>& wanted, int threads, Notices& notices,
  Progress& progress);
}
#endif
