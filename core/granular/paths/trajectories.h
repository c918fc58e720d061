// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_trajectories_h
#define granular_paths_trajectories_h

#include "granular/particles/table.h"
#include "granular/paths/path_task.h"

#include <cstdint>
#include <vector>

namespace granular
{
/// The drawn paths of particles.
struct Trajectories
{
  Table points; ///< with the arrays of vtkGranularTrajectories, and the header of the last frame
  Table cells;  ///< id and length of each: first vertices, then lines
  std::int64_t vertices = 0;
  std::vector<std::int64_t> firsts; ///< the first point of each cell
  std::vector<std::int64_t> ends;
};

/// Draws the paths of particles through loaded frames. split: cut at periodic faces. whole: the frames are all, and ids that are in none
/// are told of. piece of pieces: the wanted part of the particles of this rank. Throws what join_frames throws. Collective.
Trajectories draw_trajectories(
  PathTask& task, std::vector<PathFrame> frames, bool split, bool whole, int piece, int pieces);
}
#endif
