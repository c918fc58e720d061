// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_compare_lines_h
#define granular_paths_compare_lines_h

#include "granular/parallel/communicator.h"

#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// The change of a particle or line from a reference frame to the current frame.
enum class Change : std::int32_t
{
  Kept = 0, ///< in both frames
  New = 1,  ///< in the current frame only
  Lost = 2  ///< in the reference frame only
};

/// The particles that the lines of a rank connect: one value a line.
struct LineEnds
{
  std::span<const std::int64_t> id1;
  std::span<const std::int64_t> id2;
};

/// The change of each line of a rank.
struct LineChanges
{
  std::vector<Change> current;   ///< Kept or New
  std::vector<Change> reference; ///< Kept or Lost
};

/// Compares the lines of two frames. Lines are the same if they connect the same two particles, in any order. If a frame has
/// several such lines, the k-th one is compared with the k-th one of the other frame, and surplus ones are New or Lost; they
/// are counted by rank, then by row. Lines of both frames may be on any ranks.
///
/// Throws Error on all ranks if the numbers of ids differ; std::bad_alloc. Collective.
LineChanges compare_lines(const LineEnds& current, const LineEnds& reference, Communicator& ranks);
}
#endif
