// SPDX-License-Identifier: BSD-3-Clause
#include "granular/frames/frame_times.h"

#include "granular/numbers/number.h"
#include "granular/numbers/number_print.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace granular
{
namespace
{
using Instants = std::span<const FrameInstant>;

std::vector<double> times_of(Instants frames, const StepClock& clock)
{
  std::vector<double> times(frames.size());
  std::ranges::transform(
    frames, times.begin(), [&](const FrameInstant& frame) { return clock.time(frame.timestep); });
  return times;
}

/// The clock that the times of the headers may be of, by the last frame. A number of more digits would fit single times by
/// chance.
std::optional<StepClock> find_clock(const FrameInstant& frame)
{
  constexpr int digits = 12;
  const double size = as_printed(frame.time / static_cast<double>(frame.timestep), { digits });
  return std::isfinite(size) && size > 0 ? std::optional(StepClock(size)) : std::nullopt;
}

/// The times of the headers, without what their computation and 16 digits have added.
std::vector<double> header_times(Instants frames)
{
  constexpr double rounding =
    0x1p-50; // of two products, a number of 16 digits, and the size of a step
  std::vector<double> times(frames.size());
  std::ranges::transform(frames, times.begin(), &FrameInstant::time);
  if (const std::optional<StepClock> clock = find_clock(frames.back()))
  {
    std::vector<double> exact = times_of(frames, *clock);
    const bool same = std::ranges::equal(
      exact, times, [](double a, double b) { return std::abs(a - b) <= rounding * std::abs(a); });
    if (same && std::ranges::adjacent_find(exact, std::greater_equal<>()) == exact.end())
    {
      return exact;
    }
  }
  return times;
}

void check_finite(
  Instants frames, std::span<const double> times, double timestep_size, const std::string& path)
{
  const auto found = std::ranges::find_if(times, [](double time) { return !std::isfinite(time); });
  if (found != times.end())
  {
    throw Error("expected a TimestepSize that gives finite times, got " + to_text(timestep_size) +
        ": timestep " +
        std::to_string(frames[static_cast<std::size_t>(found - times.begin())].timestep) +
        " is at infinity; set TimestepSize to the time of one timestep",
      { path });
  }
}

/// Moves each frame that has the time of the one before, or less, to the next double after that.
void separate(Instants frames, std::span<double> times, const std::string& path, Notices& notices)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::size_t moved = 0;
  std::size_t first = 0;
  for (std::size_t i = 1; i < times.size(); ++i)
  {
    if (times[i] <= times[i - 1])
    {
      first = moved == 0 ? i : first;
      times[i] = std::nextafter(times[i - 1], infinity);
      ++moved;
    }
  }
  if (moved > 0)
  {
    notices.push_back({ { path },
      "expected timesteps below 2^53, which have times of their own, got " +
        std::to_string(frames[first - 1].timestep) + " and " +
        std::to_string(frames[first].timestep) + ": " + std::to_string(moved) + " of " +
        std::to_string(times.size()) +
        " frames are at the next double after the frame before instead of at timestep x "
        "TimestepSize; a simulation that counts from 0 (reset_timestep) helps" });
  }
}
}

bool have_times(Instants frames) noexcept
{
  return std::ranges::all_of(
           frames, [](const FrameInstant& frame) { return std::isfinite(frame.time); }) &&
    std::ranges::adjacent_find(frames, std::greater_equal<>(), &FrameInstant::time) == frames.end();
}

std::vector<double> frame_times(
  Instants frames, double timestep_size, const std::string& path, Notices& notices)
{
  if (frames.empty() || have_times(frames))
  {
    return frames.empty() ? std::vector<double>{} : header_times(frames);
  }
  std::vector<double> times = times_of(frames, StepClock(timestep_size));
  separate(frames, times, path, notices);
  check_finite(frames, times, timestep_size, path);
  return times;
}

std::vector<std::size_t> frames_in_window(
  const std::array<double, 2>& window, std::size_t frames, std::span<const double> times)
{
  const auto [first, last] = window;
  const bool all = first > last || (first <= -1e99 && last >= 1e99);
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < frames; ++i)
  {
    if (all || (i < times.size() && times[i] >= first && times[i] <= last))
    {
      numbers.push_back(i);
    }
  }
  if (numbers.empty())
  {
    throw Error("expected a TimeWindow with frames, got none from " + to_text(first) + " to " +
      to_text(last));
  }
  return numbers;
}
}
