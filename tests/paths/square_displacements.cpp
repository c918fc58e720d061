// SPDX-License-Identifier: BSD-3-Clause
// Mean square displacements: those of the walks, in integers, on any ranks and threads.
#include "granular/paths/paths.h"

#include "../support/error_of.h"
#include "../support/hard_case.h"
#include "../support/quad.h"
#include "../support/thread_ranks.h"
#include "path_checks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

using namespace granular;
using namespace path_checks;
using walks::grid;

namespace
{
using Means = SquareDisplacements::Means;

/// Of each frame, by numbers of 113 bits: the squares of displacements that are exact doubles.
std::vector<Means> means_of(const walks::Run& run)
{
  std::vector<Means> means;
  for (const auto& frame : run.frames)
  {
    Means one;
    Quad sums[4] = {};
    for (const auto& [id, place] : frame)
    {
      const auto first = run.frames[0].find(id);
      if (first == run.frames[0].end())
      {
        continue;
      }
      ++one.count;
      Quad whole = 0;
      for (std::size_t k = 0; k < 3; ++k)
      {
        const double part = walks::length_of(place[k] - first->second[k]);
        sums[k] += static_cast<Quad>(part * part);
        whole += static_cast<Quad>(part) * static_cast<Quad>(part);
      }
      sums[3] += static_cast<Quad>(static_cast<double>(whole));
    }
    const auto count = static_cast<double>(one.count);
    for (std::size_t k = 0; k < 3; ++k)
    {
      one.axes[k] = static_cast<double>(sums[k]) / count;
    }
    one.total = static_cast<double>(sums[3]) / count;
    means.push_back(one);
  }
  return means;
}

std::vector<Means> add_all(const std::vector<PathFrame>& frames, Communicator& ranks, int threads,
  std::int64_t* long_steps = nullptr)
{
  const Executor executor(threads);
  SquareDisplacements squares(ranks, executor);
  Progress progress;
  std::vector<Means> means;
  for (PathFrame frame : frames)
  {
    means.push_back(squares.add(frame, {}, progress));
  }
  if (long_steps)
  {
    *long_steps = squares.count_long_steps();
  }
  return means;
}

void expect_means(const std::vector<Means>& found, const std::vector<Means>& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t f = 0; f < found.size(); ++f)
  {
    ASSERT_EQ(found[f].count, expected[f].count) << f;
    ASSERT_EQ(bits_of(found[f].axes), bits_of(expected[f].axes))
      << f << ": " << found[f].axes[0] << " " << expected[f].axes[0];
    ASSERT_EQ(bits_of({ &found[f].total, 1 }), bits_of({ &expected[f].total, 1 })) << f;
  }
}

void check(const walks::Run& run, const walks::Shown& shown)
{
  const std::vector<Means> expected = means_of(run);
  const std::vector<PathFrame> frames = walks::frames_of(run, shown);
  on_ranks(
    [&](Communicator& ranks)
    {
      for (const auto& [deal, threads] :
        { std::pair{ Deal(by_frames), 1 }, { Deal(by_rows), 3 }, { Deal(all_on_last), 1 } })
      {
        ASSERT_NO_FATAL_FAILURE(
          expect_means(add_all(dealt(frames, deal, ranks), ranks, threads), expected));
      }
    });
}

PathFrame frame_at(const std::vector<std::int64_t>& ids, const std::vector<double>& xs)
{
  PathFrame frame = simple_frame(ids, xs);
  frame.header.box.boundary = "pp pp pp";
  frame.has_rows = false;
  frame.rows.clear();
  return frame;
}
}

TEST(SquareDisplacements, OfWalks)
{
  for (const walks::GridBox& box :
    { walks::straight_box(), walks::tilted_box(), walks::leaning_box() })
  {
    check(walks::make_run({ box }, {}, 61), { .images = false, .arrays = false });
    check(walks::make_run({ box }, { .longest = 10 * grid, .images = 7 }, 62), {});
    // particles that leave, return and come anew
    check(walks::make_run({ box }, { .longest = grid, .images = 7, .absent = 50 }, 63),
      { .rows = false });
  }
  check(walks::make_run(walks::deformed_boxes(50), { .frames = 50 }, 64), { .images = false });
  check(walks::make_run(walks::deformed_boxes(50), { .frames = 50, .images = 30 }, 65), {});
}

/// More than one chunk of particles.
TEST(SquareDisplacements, ManyParticles)
{
  const walks::Run run =
    walks::make_run({ walks::tilted_box() }, { .particles = 40'000, .frames = 2, .images = 9 }, 66);
  const std::vector<PathFrame> frames = walks::frames_of(run, { .arrays = false });
  for (const int size : { 1, 2 })
  {
    run_ranks(size,
      [&](Communicator& ranks)
      { expect_means(add_all(dealt(frames, by_rows, ranks), ranks, 3), means_of(run)); });
  }
}

/// A run that inserts its particles: they are followed from the first frame that has any.
TEST(SquareDisplacements, NothingInTheFirstFrames)
{
  const std::vector<PathFrame> all = walks::frames_of(
    walks::make_run({ walks::tilted_box() }, { .frames = 5 }, 67), { .arrays = false });
  std::vector<PathFrame> late = all;
  std::ranges::fill(late.begin(), late.begin() + 2, frame_at({}, {}));
  const std::vector<PathFrame> rest(all.begin() + 2, all.end());
  on_ranks(
    [&](Communicator& ranks)
    {
      std::vector<Means> means = add_all(dealt(late, by_rows, ranks), ranks, 1);
      for (const std::size_t frame : { 0U, 1U })
      {
        EXPECT_EQ(means[frame].count, 0);
        EXPECT_TRUE(std::isnan(means[frame].total) && std::isnan(means[frame].axes[2]));
      }
      means.erase(means.begin(), means.begin() + 2);
      expect_means(means, add_all(dealt(rest, by_rows, ranks), ranks, 1));
    });
}

/// Squares are summed exactly: one particle that goes far does not hide what others do.
TEST(SquareDisplacements, AreSummedExactly)
{
  HardCase hard("trajectories",
    "mean square displacements of steps of 1e-6 to 1e6: not the correctly rounded sum by the "
    "number",
    "means", 0);
  std::mt19937_64 random(8);
  for (int trial = 0; trial < 20; ++trial)
  {
    std::vector<std::int64_t> ids(500);
    std::vector<double> xs(500);
    Quad sum = 0;
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      ids[i] = static_cast<std::int64_t>(i);
      xs[i] = std::pow(10, static_cast<double>(random() % 13) - 6) *
        (1 + static_cast<double>(random() % 1000) / 1000);
      sum += static_cast<Quad>(xs[i] * xs[i]);
    }
    std::vector<PathFrame> frames = { frame_at(ids, std::vector<double>(500)), frame_at(ids, xs) };
    for (PathFrame& frame : frames)
    {
      frame.coordinates = Coordinates::Unwrapped;
    }
    on_ranks(
      [&](Communicator& ranks)
      {
        const Means means = add_all(dealt(frames, by_rows, ranks), ranks, 2)[1];
        if (ranks.rank() == 0)
        {
          hard.add(means.axes[0] == static_cast<double>(sum) / 500 &&
                means.total == means.axes[0] && means.axes[1] == 0
              ? 0
              : 1);
        }
      });
  }
}

TEST(SquareDisplacements, LongStepsAreCounted)
{
  const std::vector<PathFrame> frames = { frame_at({ 1, 2 }, { 1, 1 }),
    frame_at({ 2, 1 }, { 3.4, 4 }), frame_at({ 1, 3 }, { 9, 5 }) };
  on_ranks(
    [&](Communicator& ranks)
    {
      std::int64_t steps = 0;
      add_all(dealt(frames, by_frames, ranks), ranks, 1, &steps);
      EXPECT_EQ(steps, 2);
    });
}

/// Where a place is no number, neither is the mean.
TEST(SquareDisplacements, PlacesThatAreNoNumbers)
{
  for (const double odd :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    const std::vector<PathFrame> frames = { frame_at({ 1, 2 }, { 1, 1 }),
      frame_at({ 1, 2 }, { 2, odd }), frame_at({ 1, 2 }, { 2, 1 }) };
    on_ranks(
      [&](Communicator& ranks)
      {
        const std::vector<Means> means = add_all(dealt(frames, by_rows, ranks), ranks, 1);
        EXPECT_EQ(means[1].count, 2);
        EXPECT_TRUE(std::isnan(means[1].total)) << means[1].total;
        EXPECT_TRUE(std::isnan(means[1].axes[0]));
        EXPECT_EQ(means[1].axes[1], 0);
        EXPECT_EQ(means[2].total, 0.5);
      });
  }
}

TEST(SquareDisplacements, RepeatedIds)
{
  std::vector<PathFrame> frames = { frame_at({ 1, 2, 3 }, { 1, 2, 3 }),
    frame_at({ 1, 2, 3, 2 }, { 1, 2, 3, 4 }) };
  frames[1].has_rows = true;
  frames[1].rows = { 5, 6, 7, 8 };
  const auto error = [](Communicator& ranks, const std::vector<PathFrame>& own)
  { return error_of([&] { add_all(own, ranks, 1); }); };
  on_ranks(
    [&](Communicator& ranks)
    {
      const std::string said = error(ranks, dealt(frames, by_rows, ranks));
      EXPECT_NE(said.find("expected each id once in a frame, got id 2 in rows "), std::string::npos)
        << said;
    });
  SerialCommunicator alone;
  EXPECT_EQ(error(alone, frames),
    "expected each id once in a frame, got id 2 in rows 6 and 8 of timestep 50 (rows are counted "
    "from 0)");
  // also of one that was not there at first
  frames[1].ids = { 1, 9, 3, 9 };
  EXPECT_NE(error(alone, frames).find("got id 9 in rows 6 and 8"), std::string::npos)
    << error(alone, frames);
  frames.resize(1);
  frames[0].ids = { 1, 2, 1 };
  EXPECT_NE(error(alone, frames).find("got id 1 in rows"), std::string::npos);
  const Executor executor(1);
  Progress progress;
  SquareDisplacements squares(alone, executor);
  const auto name = [](std::int64_t id) { throw Error("named " + std::to_string(id)); };
  EXPECT_EQ(error_of([&] { squares.add(frames[0], name, progress); }), "named 1");
}
