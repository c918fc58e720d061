// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_particle_values_h
#define granular_local_particle_values_h

#include "granular/common/progress.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace granular
{
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

/// Returns the values of a frame without copying where possible. Positions are computed if the points are scaled or
/// unwrapped, or not contiguous doubles. Arrays that a frame without rows lacks have size 0. Throws Error if an array,
/// the points, or the box of scaled points is missing, or if texts are requested; Cancelled; std::bad_alloc.
ParticleValues view_particles(const FrameView& frame, std::span<const std::string> names,
  const Executor& executor, Progress& progress);

/// Gives arrays of size 0 the size that they have on other ranks, or 1. Throws Error if ranks disagree. Collective.
void share_sizes(ParticleValues& particles, std::int64_t rows, Communicator& ranks);
}
#endif
