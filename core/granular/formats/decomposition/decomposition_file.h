// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_decomposition_decomposition_file_h
#define granular_formats_decomposition_decomposition_file_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/frames/file_format.h"
#include "granular/frames/frame.h"
#include "granular/frames/run_index.h"
#include "granular/grid/subdomains.h"

#include <string>
#include <vector>

namespace granular
{
/// Files of dump decomposition/vtk, for a RunIndex: legacy VTK files with a rectilinear grid (LIGGGHTS-PUBLIC, PFM) or an
/// unstructured one (LIGGGHTS-INL, this library; versions 2.0 to 5.1, ASCII and BINARY), and .vtu files, which are one frame
/// each.
///
/// Timesteps are those of the names (name_steps). A file may hold several rectilinear grids, one after the other. Left out
/// with a notice: a header without a grid, which LIGGGHTS leaves when a timestep is written twice; and data that contradict
/// the format, up to the next header. After 100 in a file such frames are only counted. An incomplete last grid is left out
/// silently. In a file that has grown the last frame is read again, because data of its cells may have been added. More than
/// 2^24 ranks are not read.
const FileFormat& decomposition_format() noexcept;

/// Returns true if the contents of a file are a decomposition; all other .vtk and .vtu files are for others. Rectilinear:
/// with the title of LIGGGHTS, and no data. Unstructured: voxels or hexahedra, at most eight points per cell, the first one a
/// box along the axes, and cell data `nlocal`; in .vtu files also `proc` or `procID`. Returns false, and never throws, for
/// unreadable files.
bool is_decomposition_file(const std::string& path) noexcept;

/// Decodes a frame. In a rectilinear grid the number of coordinates counts, not DIMENSIONS, which PFM writes for the whole
/// grid into the files of single ranks. Voxels in the order of LIGGGHTS-INL, with x and z exchanged, are corrected with a
/// notice; hexahedra along the axes are accepted. Ranks come from the cell array `proc` (or `procID`), counts from `nlocal`.
/// The pieces of a .vtu file come one after the other; an array counts if all pieces with cells have it. Throws Error with
/// path and line or byte; Cancelled.
Decomposition read_decomposition(
  const ByteSource& source, const FrameEntry& entry, Notices& notices, Progress& progress);

/// Decodes all pieces of a frame. Files of single ranks without their numbers are those of ranks 0, 1, ...
Decomposition read_decomposition_pieces(
  const std::vector<FramePiece>& pieces, Notices& notices, Progress& progress);

/// Returns the notice that cells were corrected.
Notice note_reflected(const Where& where, std::int64_t cells);
}
#endif
