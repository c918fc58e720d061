// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_compare_frames_h
#define granular_paths_compare_frames_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/lines/line_rows.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"
#include "granular/particles/table.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace granular
{
/// The frame that the shown one is compared with.
enum class ReferenceFrame : std::uint8_t
{
  First,    ///< the first one; of particles the first one that has any
  Previous, ///< the one before the shown one
  Time      ///< the last one at or before a time, or the first one
};

struct FrameCompareRequest
{
  ReferenceFrame reference = ReferenceFrame::First;
  double reference_time = 0;
  std::vector<double> times = {};   ///< of all frames; none: there is one frame
  std::size_t shown = 0;            ///< the number of the shown frame
  std::size_t reference_number = 0; ///< of the reference frame: see find_reference
  std::string
    differences; ///< names of particle arrays, separated by blanks or commas; "*": all of both frames
  std::string mass_array = "mass"; ///< else masses are those of spheres by density and radius
  int piece = 0;                   ///< part of the results that is wanted of what these ranks have
  int pieces = 1;
  int threads = 1; ///< at least 1; changes no result
};

/// Returns the number of the reference frame. find_first returns that of the first frame with particles; empty: of lines. Throws Error
/// for a time that is not finite.
std::size_t find_reference(
  const FrameCompareRequest& request, const std::function<std::size_t()>& find_first);

/// A frame of a rank: particles, lines, or both.
struct ComparedInput
{
  const FrameView* particles = nullptr;
  const LineRows* lines = nullptr;
};

/// The rows of a result: those of the current frame, then those of the reference frame that are lost.
struct ComparedRows
{
  std::vector<std::int64_t> rows; ///< of lines: cells
  std::vector<std::int64_t> lost;
  Table made; ///< an array for each property of the rows of both: see vtkGranularCompare
};

struct ComparedFrames
{
  ComparedRows particles;
  ComparedRows lines;
};

/// Compares the particles, the lines, or both, of two frames. Notices tell of displacements that may be wrong, of lines without particles or
/// places, and of a reference frame behind empty ones. Throws what compare_particles, find_fragments and LineRows throw. Collective.
ComparedFrames compare_frames(const ComparedInput& current, const ComparedInput& reference,
  const FrameCompareRequest& request, Communicator& ranks, Notices& notices,
  PartialProgress& progress);
}
#endif
