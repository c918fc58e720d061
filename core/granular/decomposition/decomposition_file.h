// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_decomposition_file_h
#define granular_decomposition_decomposition_file_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/decomposition/subdomains.h"
#include "granular/frames/file_format.h"
#include "granular/frames/frame.h"

#include <string>
#include <string_view>

namespace granular
{
/// The files of dump decomposition/vtk, for a RunIndex: legacy VTK files with a rectilinear grid
/// (LIGGGHTS-PUBLIC, PFM), or with an unstructured one (LIGGGHTS-INL, this library; versions 2.0 to 5.1, ASCII and
/// BINARY), and .vtu files, which are a frame each.
///
/// Timesteps are those of the names (name_steps). A file may hold several rectilinear grids, one after the
/// other. Left out with a notice: a header without a grid, as LIGGGHTS leaves it where a timestep is written twice;
/// what is not as the format says, up to the next header; after 100 of a file such frames are only counted. A last grid that is not complete is left out silently. In a
/// file that has grown the last frame is looked at again: data of its cells may have come. More than 2^24 processes
/// are not read.
const FileFormat& decomposition_format() noexcept;

/// Whether a file is one of these, by content; all other .vtk and .vtu files are for others. Rectilinear: with the
/// title that LIGGGHTS writes, and no data. Unstructured: voxels or hexahedra, at most eight points a cell, the first
/// of them a box along the axes, and cell data `nlocal`; in .vtu files also `proc` or `procID`. Never throws: what cannot
/// be read is none.
bool is_decomposition_file(const std::string& path) noexcept;

/// Whether the first bytes of a file are those of XML files of VTK.
bool is_vtu(std::string_view first_bytes) noexcept;

/// Decodes a frame. Of a rectilinear grid the numbers of coordinates count, whatever DIMENSIONS
/// say: PFM writes those of the whole grid into the files of single processes. Cells that are voxels in the order of
/// LIGGGHTS-INL, x and z exchanged, are put right with a notice; hexahedra along the axes will do, too. Ranks are
/// those of the cell array `proc` (or `procID`), counts those of `nlocal`. The pieces of a .vtu file come one after the
/// other; an array counts if all pieces that have cells have it. Throws Error with path and line or byte;
/// Cancelled.
Decomposition read_decomposition(
  const ByteSource& source, const FrameEntry& entry, Notices& notices, Progress& progress);

/// Says once that cells were put right.
Notice note_reflected(const Where& where, std::int64_t cells);
}
#endif
