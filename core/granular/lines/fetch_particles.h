// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_lines_fetch_particles_h
#define granular_lines_fetch_particles_h

#include "granular/common/progress.h"
#include "granular/lines/id_finder.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace granular
{
/// The ids in an array of numbers: used in place if they are contiguous Int64, otherwise converted.
class Ids
{
public:
  Ids() = default;

  /// Throws Error with the array's name and the row if there is more than one number per row, or one that is not a
  /// 64-bit integer: a fraction, nan, or too large; Cancelled; std::bad_alloc.
  Ids(const ArrayView& array, std::int64_t rows, const Executor& executor, Progress& progress);

  std::span<const std::int64_t> values() const noexcept { return values_; }

private:
  std::vector<std::int64_t> own_;
  std::span<const std::int64_t> values_; ///< stay where they are when this is moved
};

/// Returns the ids in the array `id` of a frame; none if there is no such array because there are no rows. Throws Error that
/// names whose the ids would be ("particles"), and what Ids throws.
Ids load_ids(
  const FrameView& frame, const std::string& whose, const Executor& executor, Progress& progress);

/// Positions of particles, and some of their arrays, in any order of rows.
struct ParticleValues
{
  const double* points =
    nullptr; ///< x y z of the first: absolute, but unwrapped where the frame's points are
  std::int64_t point_step = 3;   ///< numbers from one to the next
  std::vector<ArrayView> arrays; ///< of numbers, in the order in which they are wanted
  std::vector<double>
    own; ///< what is in no memory of the frame's; stays where it is when this is moved
};

/// Returns each name once, in the order in which they first occur.
std::vector<std::string> distinct_names(std::vector<std::string> names);

/// Returns the values of a frame without copying where possible. Positions are computed if the points are scaled or
/// unwrapped, or not contiguous doubles. Arrays that a frame without rows lacks have size 0. Throws Error if an array,
/// the points, or the box of scaled points is missing, or if texts are requested; Cancelled; std::bad_alloc.
ParticleValues view_particles(const FrameView& frame, std::span<const std::string> names,
  const Executor& executor, Progress& progress);

/// Gives arrays of size 0 the size that they have on other ranks, or 1. Throws Error if ranks disagree. Collective.
void share_sizes(ParticleValues& particles, std::int64_t rows, Communicator& ranks);

/// Particles that one rank has requested from all ranks.
struct FetchedParticles
{
  std::vector<std::int64_t> ids; ///< each once
  ParticleValues values;         ///< as doubles
  std::int64_t repeated = 0;     ///< particles that this rank has seen whose id an earlier one has
};

/// Fetches the particles with the wanted ids, each once in the list, from whichever rank owns them; ids that no rank owns are
/// left out. The directory is that of the particles of all ranks, in the rows of their values: of particles with the same id,
/// the first of the lowest rank counts. Collective.
FetchedParticles fetch_particles(const ParticleValues& own, const IdDirectory& directory,
  const std::vector<std::int64_t>& wanted, Communicator& ranks);
}
#endif
