// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_compare_particles_h
#define granular_paths_compare_particles_h

#include "granular/common/progress.h"
#include "granular/memory/block.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <span>
#include <string>
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
