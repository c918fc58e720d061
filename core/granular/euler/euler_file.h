// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_euler_euler_file_h
#define granular_euler_euler_file_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/frames/file_format.h"
#include "granular/frames/frame.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The files of dump euler/vtk, for a RunIndex: one frame each, legacy VTK of versions 1.0 to 5.1, ASCII or BINARY.
/// Points with a vertex each (LIGGGHTS, its forks), or, of PFM, a rectilinear grid or hexahedra with the data in the
/// cells. Timesteps are those of the names. A file that is not complete is left out silently, one that is not as the format
/// says with a notice. LIGGGHTS' own must have all of v_avg, volumefraction, radius and pressure, others the first two.
const FileFormat& euler_format() noexcept;

/// Whether a file is one of these, by content: it has arrays v_avg and volumefraction of its points or cells. One with the
/// title that LIGGGHTS writes may also end, or go wrong, before these if its points are vertices, which those of its meshes
/// are not, or be no more than a header. Never throws: what cannot be read is none.
bool is_euler_file(const std::string& path) noexcept;

/// Values of cells as a file names them: v_avg, volumefraction, ... (see euler_arrays), or others.
struct EulerValues
{
  std::string name;
  int components = 1;
  std::vector<double> values; ///< components for each cell
};

/// A frame as it stands in a file. Numbers are the nearest doubles to the text, whatever type the file names; nan and
/// infinities are numbers.
struct EulerFrame
{
  std::int64_t cells = 0;
  std::vector<double> centres; ///< x y z of each; the middle of cells with faces
  std::vector<EulerValues> arrays;

  /// Of a rectilinear grid the faces along each axis, as the file has them; else empty.
  std::vector<double> faces[3];
};

/// Decodes a frame; of arrays those that `wanted` says yes to by name; arrays of text are left out with a notice. Throws Error with path and line or byte;
/// Cancelled.
EulerFrame read_euler(const ByteSource& source, const FrameEntry& entry,
  const std::function<bool(std::string_view)>& wanted, Notices& notices, Progress& progress);

/// The names of the arrays of a frame, without reading their values.
std::vector<std::string> euler_array_names(
  const ByteSource& source, const FrameEntry& entry, Progress& progress);
}
#endif
