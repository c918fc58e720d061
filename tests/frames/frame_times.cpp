// SPDX-License-Identifier: BSD-3-Clause
// One clock for dumps with ITEM: TIME and for those with TimestepSize.
#include "granular/frames/frame_times.h"

#include "../support/error_of.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

using namespace granular;

namespace
{
constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t two_53 = std::int64_t{ 1 } << 53;

struct Result
{
  std::vector<double> times;
  Notices notices;
};

Result times_of(const std::vector<FrameInstant>& frames, double size)
{
  Result result;
  result.times = frame_times(frames, size, "a.dump", result.notices);
  return result;
}

std::vector<FrameInstant> steps(const std::vector<std::int64_t>& timesteps)
{
  std::vector<FrameInstant> frames;
  for (const std::int64_t step : timesteps)
  {
    frames.push_back({ step, none });
  }
  return frames;
}

/// A number as printf prints it and strtod reads it.
double printed(const char* format, double value)
{
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return std::strtod(text, nullptr);
}

/// The double nearest to a decimal number of that many units.
double decimal(std::int64_t units, int power)
{
  return std::strtod((std::to_string(units) + "e" + std::to_string(power)).c_str(), nullptr);
}
}

/// LAMMPS prints ITEM: TIME with {:.16}, of timestep * dt in doubles.
TEST(FrameTimes, TimesOfHeadersAndOfTimestepSizeAreOneClock)
{
  for (const int power : { -5, -6, -7, -3 })
  {
    for (const std::int64_t unit : { 1, 2, 5, 25 })
    {
      const double size = decimal(unit, power);
      std::vector<FrameInstant> with_time;
      std::vector<FrameInstant> without;
      std::vector<double> expected;
      for (std::int64_t step = 0; step <= 100000; step += 100)
      {
        with_time.push_back({ step, printed("%.16g", static_cast<double>(step) * size) });
        without.push_back({ step, none });
        expected.push_back(decimal(step * unit, power));
      }
      EXPECT_TRUE(times_of(with_time, 1).times == expected) << size;
      EXPECT_TRUE(times_of(without, size).times == expected) << size;
    }
  }
}

TEST(FrameTimes, TimesThatNoStepGivesStayAsTheyAre)
{
  const double third = 1. / 3;
  const double next = std::nextafter(5e-05, 1);
  const std::vector<std::vector<FrameInstant>> runs = {
    { { 0, 0.1 }, { 10, 0.2 }, { 20, 0.30000000000000004 } },   // starts later
    { { 0, 0 }, { 10, 1e-3 }, { 20, 1.5e-3 } },                 // the size of a step changed
    { { 3, 3 * third }, { 7, 7 * third }, { 11, 11 * third } }, // no decimal number
    { { 0, next } },
    { { 5, std::nextafter(std::nextafter(next, 1), 1) * (1 + 0x1p-48) } },
    { { two_53, 1 }, { two_53 + 1, 1 + 0x1p-52 } },
  };
  for (const std::vector<FrameInstant>& frames : runs)
  {
    const Result result = times_of(frames, 1);
    std::vector<double> expected;
    std::ranges::transform(frames, std::back_inserter(expected), &FrameInstant::time);
    EXPECT_EQ(result.times, expected);
    EXPECT_TRUE(result.notices.empty());
  }
}

TEST(FrameTimes, TimestepsBeyond2To53HaveTimesOfTheirOwnAndItIsSaid)
{
  const Result result =
    times_of(steps({ two_53 - 1, two_53, two_53 + 1, two_53 + 2, two_53 + 8 }), 1);
  const auto at = [](std::int64_t step) { return static_cast<double>(step); };
  EXPECT_EQ(result.times,
    (std::vector<double>{
      at(two_53) - 1, at(two_53), at(two_53) + 2, at(two_53) + 4, at(two_53) + 8 }));
  ASSERT_EQ(result.notices.size(), 1u);
  EXPECT_EQ(to_string(result.notices[0]),
    "a.dump: expected timesteps below 2^53, which have times of their own, got 9007199254740992 "
    "and "
    "9007199254740993: 2 of 5 frames are at the next double after the frame before instead of at "
    "timestep x TimestepSize; a simulation that counts from 0 (reset_timestep) helps");
  EXPECT_TRUE(times_of(steps({ two_53, two_53 + 2 }), 1).notices.empty());
}

TEST(FrameTimes, NegativeTimestepsToo)
{
  const Result result = times_of(steps({ -two_53 - 1, -two_53, -1, 0, 3 }), 1e-5);
  EXPECT_TRUE(std::ranges::is_sorted(result.times, std::less_equal<>()));
  EXPECT_EQ(result.times.back(), 3e-05);
  EXPECT_EQ(result.notices.size(), 1u);
}

TEST(FrameTimes, InfiniteTimesAreAnError)
{
  EXPECT_EQ(error_of(
              [] {
                times_of(steps({ 0, 1000, 1000000000 }), 1e300);
              }),
    "a.dump: expected a TimestepSize that gives finite times, got 1e+300: timestep 1000000000 is "
    "at infinity; set TimestepSize to the time of one timestep");
  EXPECT_EQ(times_of(steps({ 0, 1000 }), 1e300).times, (std::vector<double>{ 0, 1e303 }));
}

TEST(FrameTimes, OfNoFramesThereAreNone)
{
  EXPECT_TRUE(times_of({}, 1).times.empty());
}
