// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_frame_times_h
#define granular_frames_frame_times_h

#include "granular/common/error.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace granular
{
/// The timestep and time in the header of a frame.
struct FrameInstant
{
  std::int64_t timestep = 0;
  double time = 0; ///< ITEM: TIME; nan where there is none
};

/// Returns true if every frame has a finite ITEM: TIME and these strictly increase.
bool have_times(std::span<const FrameInstant> frames) noexcept;

/// Returns the time of every frame [s], strictly increasing. Timesteps must be strictly increasing.
///
/// - ITEM: TIME if have_times. LAMMPS multiplies doubles and prints 16 digits, of which the last may be wrong: 7 steps
///   of 1e-05 print 7.000000000000001e-05. If all times equal, to 2^-50 of their values, the timesteps times one
///   decimal number of 12 digits, they are replaced by those of its StepClock.
/// - Otherwise the times of the StepClock of timestep_size. From 2^53 on several timesteps would share a time: such a
///   frame then gets the next double after the time of the frame before, and a notice names the path and the first two
///   such timesteps.
///
/// Throws Error if timestep_size makes a time infinite.
std::vector<double> frame_times(std::span<const FrameInstant> frames, double timestep_size,
  const std::string& path, Notices& notices);

/// Returns the numbers of the frames in a window: first and last time, or all if the first is above the last or both are beyond 1e99, the
/// widest that forms show. times: of all frames, or none. Throws Error if there is no frame in it.
std::vector<std::size_t> frames_in_window(
  const std::array<double, 2>& window, std::size_t frames, std::span<const double> times);
}
#endif
