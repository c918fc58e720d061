// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_compare_particles_h
#define granular_paths_compare_particles_h

#include "granular/common/progress.h"
#include "granular/memory/block.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"
#include "granular/paths/compare_lines.h"

#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// The arrays that particles get from their state in another frame.
struct ParticleCompareRequest
{
  std::vector<std::string>
    differences;   ///< arrays whose difference, current minus reference, is wanted
  int threads = 1; ///< at least 1; changes no result
};

/// The differences of an array: current rows x size doubles.
struct DifferenceArray
{
  std::string name; ///< A_difference
  int size = 1;
  Block values;
};

/// The changes of the particles of a rank.
struct ComparedParticles
{
  std::vector<Change> changes; ///< of each current row: Kept or New
  Block displacements;         ///< x y z of each current row, as doubles; nan for new particles
  std::vector<DifferenceArray> differences; ///< nan for new particles
  std::vector<std::int64_t> lost;           ///< rows of the reference frame on this rank, in order
  bool unwrapped =
    false; ///< displacements are exact; otherwise the shortest periodic image is taken
  std::int64_t far =
    0; ///< particles of all ranks whose shortest image is longer than a quarter of a period: it may be wrong
};

/// Compares the particles of two frames by their integer arrays `id`. Particles of both frames may be on any ranks. Ranks
/// without particles may lack all arrays, but have the headers of the other ranks: see share_header. Duplicate ghosts get
/// values, but are neither counted nor lost.
///
/// The displacement is that of unwrapped positions, each with the box of its own frame, if the points of each frame are
/// unwrapped or have an integer array `image` of three counts and a box. It is rounded once: half an ulp, and 2^-100 of its
/// terms. Otherwise it is the shortest periodic image in the current box, or in the box of the reference frame where the
/// current one has none. Scaled points are made absolute first, rounded once.
///
/// Differences are those of doubles, each rounded once, one array for each distinct name in order. Threads and ranks change no
/// bit.
///
/// Throws Error on all ranks if an id repeats (see IdDirectory::expect_distinct), is missing or is not an integer, if a wanted
/// array is missing, not numeric, or of another size in the reference frame; Cancelled; std::bad_alloc. Collective.
ComparedParticles compare_particles(const FrameView& current, const FrameView& reference,
  const ParticleCompareRequest& request, Communicator& ranks, Progress& progress);
}
#endif
