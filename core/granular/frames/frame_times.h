// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_frame_times_h
#define granular_frames_frame_times_h

#include "granular/common/error.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace granular
{
/// What the header of a frame says of its place in time.
struct FrameInstant
{
  std::int64_t timestep = 0;
  double time = 0; ///< ITEM: TIME; nan where there is none
};

/// Whether every frame has a finite ITEM: TIME, and these strictly increase.
bool have_times(std::span<const FrameInstant> frames) noexcept;

/// Returns the time of every frame [s], strictly increasing. Timesteps must be.
///
/// - ITEM: TIME where have_times. LAMMPS multiplies doubles and prints 16 digits, the last of which may be wrong: 7 steps of
///   1e-05 print 7.000000000000001e-05. Where all times are, to 2^-50 of themselves, the timesteps times one decimal number
///   of 12 digits, they are those of its StepClock.
/// - Else those of the StepClock of timestep_size. From 2^53 on several timesteps would share a time: a frame is then at the
///   next double after the frame before, and a notice names path and the first two such timesteps.
///
/// Throws Error where timestep_size makes a time infinite.
std::vector<double> frame_times(std::span<const FrameInstant> frames, double timestep_size,
  const std::string& path, Notices& notices);
}
#endif
