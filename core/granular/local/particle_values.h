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
/// Where particles are, and arrays of theirs, in any order of rows.
struct ParticleValues
{
  const double* points =
    nullptr; ///< x y z of the first: absolute, but unwrapped where the frame's points are
  std::int64_t point_step = 3;   ///< numbers from one to the next
  std::vector<ArrayView> arrays; ///< of numbers, in the order in which they are wanted
  std::vector<double>
    own; ///< what is in no memory of the frame's; stays where it is when this is moved
};

/// Sees the values of a frame where they are; positions are computed where the points are something else, or not
/// doubles one after the other. Arrays that a frame without rows lacks are of size 0. Throws Error if an array, the
/// points or the box of scaled ones are not there, or texts are wanted; Cancelled; std::bad_alloc.
ParticleValues view_particles(const FrameView& frame, std::span<const std::string> names,
  const Executor& executor, Progress& progress);

/// Gives arrays of size 0 that which they have on other ranks, or 1. Throws Error where ranks differ. Collective.
void share_sizes(ParticleValues& particles, std::int64_t rows, Communicator& ranks);
}
#endif
