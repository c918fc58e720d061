// SPDX-License-Identifier: BSD-3-Clause
// Which rows are counted, from points of all kinds; threads, progress and cancelling.
#include "../grid/made_subdomains.h"
#include "../support/stop.h"
#include "counted_frames.h"

#include "granular/common/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

using namespace granular;

namespace
{
ProcessGrid two_halves()
{
  return make_process_grid({ { 0, 0, 0 }, { 8, 1, 1 }, 0, { 2, 1, 1 }, {} });
}
}

TEST(CountedRows, DuplicatesAreLeftOut)
{
  const std::vector<unsigned char> ghosts = { 0, 1, 2, 3, 0 };
  const Points points = { { 1, 0, 0 }, { 1, 0, 0 }, { 5, 0, 0 }, { 5, 0, 0 }, { 9, 0, 0 } };
  FrameView frame = frame_of(points);
  frame.ghosts = ghosts.data();
  EXPECT_EQ(count(frame, two_halves()), (ParticleCounts{ { 1, 1 }, 1 }));
  EXPECT_EQ(count(frame, made_bisection(3, 1)).outside, 2);
}

TEST(CountedRows, FloatsStridesAndOriginsAreAbsolutePositions)
{
  const std::vector<float> floats = { 1, 0, 0, 7, 4, 0, 0, 7, 3.9999998F, 1, 1, 7 };
  FrameView frame = frame_of({});
  frame.rows = 3;
  frame.points = view_rows("points", ValueType::Float32, floats.data(), 4);
  EXPECT_EQ(count(frame, two_halves()), (ParticleCounts{ { 2, 1 }, 0 }));
  const std::vector<double> strided = { 1, 0, 0, 7, 4, 0, 0, 7, std::nextafter(4, 0), 1, 1, 7 };
  frame.points = view_rows("points", ValueType::Float64, strided.data(), 4);
  EXPECT_EQ(count(frame, two_halves()), (ParticleCounts{ { 2, 1 }, 0 }));
  frame.point_origin = { 1, 0, 0 };
  EXPECT_EQ(count(frame, two_halves()), (ParticleCounts{ { 1, 2 }, 0 }));
}

TEST(CountedRows, PeriodicAxesAreWrapped)
{
  const Points points = { { -1, 0, 0 }, { 8, 0, 0 }, { 17, 0, 0 }, { 4, -0.5, 0 } };
  FrameView frame = frame_of(points);
  EXPECT_EQ(count(frame, two_halves()), (ParticleCounts{ { 0, 1 }, 3 }));
  frame.has_box = true;
  frame.header.box = Box::from_bounds({ 0, 0, 0 }, { 8, 1, 1 });
  frame.header.box.boundary = "pp ff ff";
  EXPECT_EQ(count(frame, two_halves()), (ParticleCounts{ { 2, 1 }, 1 }));
}

TEST(CountedRows, PointsAreNeededWhereThereAreRows)
{
  FrameView frame;
  frame.has_box = false;
  EXPECT_EQ(count(frame, two_halves()), (ParticleCounts{ { 0, 0 }, 0 }));
  frame.rows = 1;
  EXPECT_THROW(count(frame, two_halves()), Error);
}

TEST(CountedRows, ThreadsDoNotShow)
{
  std::mt19937_64 random(1);
  const Points points = chosen_points(400'000, {}, { -0.1, 0, 0 }, { 1, 1, 1 }, random);
  std::vector<unsigned char> ghosts(points.size());
  for (unsigned char& ghost : ghosts)
  {
    ghost = static_cast<unsigned char>(random() % 4);
  }
  FrameView frame = frame_of(points);
  frame.ghosts = ghosts.data();
  const ProcessGrid grid = make_process_grid({ { 0, 0, 0 }, { 1, 1, 1 }, 0, { 7, 5, 3 }, {} });
  Subdomains overlapping = made_bisection(50, 1);
  for (Subdomain& subdomain : overlapping)
  {
    subdomain.hi[1] += 0.1;
  }
  const ParticleCounts in_grid = count(frame, grid, 1);
  const ParticleCounts in_others = count(frame, overlapping, 1);
  EXPECT_GT(in_grid.outside, 0);
  for (const int threads : { 2, 3, 16 })
  {
    EXPECT_EQ(count(frame, grid, threads), in_grid);
    EXPECT_EQ(count(frame, overlapping, threads), in_others);
  }
}

TEST(CountedRows, StopsAtEachReport)
{
  const Points points(300'000, { 0.5, 0.5, 0.5 });
  const FrameView frame = frame_of(points);
  const Subdomains subdomains = made_bisection(5, 1);
  for (const int threads : { 1, 3 })
  {
    Stop never;
    count_in_grid(frame, two_halves(), Executor(threads), never);
    ASSERT_GT(never.reports, 0);
    for (int at = 0; at < (threads == 1 ? never.reports : 1); ++at)
    {
      Stop grid(at);
      EXPECT_THROW(count_in_grid(frame, two_halves(), Executor(threads), grid), Cancelled);
      EXPECT_EQ(grid.reports, at + 1);
      Stop tree(at);
      EXPECT_THROW(count_in_subdomains(frame, subdomains, Executor(threads), tree), Cancelled);
      Stop bounds(at);
      EXPECT_THROW(bounds_of_particles(frame, Executor(threads), bounds), Cancelled);
    }
  }
}
