// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_euler_euler_file_h
#define granular_formats_euler_euler_file_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/frames/file_format.h"
#include "granular/frames/frame.h"
#include "granular/frames/run_index.h"
#include "granular/grid/cells.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Files of dump euler/vtk, for a RunIndex: one frame each, legacy VTK of versions 1.0 to 5.1, ASCII or BINARY. They hold
/// points with a vertex each (LIGGGHTS, its forks), or, from PFM, a rectilinear grid or hexahedra with the data in the cells.
/// Timesteps are those of the names. An incomplete file is left out silently, a file that contradicts the format with a
/// notice. LIGGGHTS' own must have all of v_avg, volumefraction, radius and pressure, others the first two.
const FileFormat& euler_format() noexcept;

/// Returns true if the contents of a file have arrays v_avg and volumefraction of their points or cells. A file with
/// LIGGGHTS' title may also end, or go wrong, before these if its points are vertices, unlike those of meshes, or be only a
/// header. Returns false, and never throws, for unreadable files.
bool is_euler_file(const std::string& path) noexcept;

/// Decodes a frame, with the arrays that `wanted` accepts by name; arrays of text are left out with a notice. Throws Error
/// with path and line or byte; Cancelled.
EulerFrame read_euler(const ByteSource& source, const FrameEntry& entry,
  const std::function<bool(std::string_view)>& wanted, Notices& notices, Progress& progress);

/// Decodes all pieces of a frame as one, with the arrays that all pieces with cells have; a notice names each of the others. There
/// are no faces if several pieces have cells. threads: for Kind::cells; one reads.
EulerFrame read_euler_pieces(const std::vector<FramePiece>& pieces,
  const std::function<bool(std::string_view)>& wanted, int threads, Notices& notices,
  Progress& progress);

/// Returns the names of the arrays of a frame, without reading their values.
std::vector<std::string> euler_array_names(
  const ByteSource& source, const FrameEntry& entry, Progress& progress);
}
#endif
