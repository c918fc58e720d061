// SPDX-License-Identifier: BSD-3-Clause
// Frames joined to paths: those of walks on a grid, on which all is exact.
#include "../support/error_of.h"
#include "../support/hard_case.h"
#include "../support/quad.h"
#include "../support/stop.h"
#include "../support/thread_ranks.h"
#include "path_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace granular;
using namespace path_checks;
using walks::grid;

namespace
{
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

Paths join_alone(
  const std::vector<PathFrame>& frames, const PathJoin& options = {}, Notices* notices = nullptr)
{
  SerialCommunicator alone;
  return join(frames, options, alone, notices);
}

std::vector<double> xs_of(const Paths& paths)
{
  std::vector<double> xs;
  for (std::size_t i = 0; i < paths.points.size(); i += 3)
  {
    xs.push_back(paths.points[i]);
  }
  return xs;
}

PathArray array_of(const std::vector<double>& values, int size = 1)
{
  PathArray array{ "a", size, false, {} };
  for (const double value : values)
  {
    array.words.push_back(std::bit_cast<std::int64_t>(value));
  }
  return array;
}

std::vector<double> values_of(const PathArray& array)
{
  std::vector<double> values;
  for (const std::int64_t word : array.words)
  {
    values.push_back(array.integers ? static_cast<double>(word) : std::bit_cast<double>(word));
  }
  return values;
}

Quad exact(const Twofold& number)
{
  return static_cast<Quad>(number.hi) + static_cast<Quad>(number.lo);
}
}

TEST(PathsJoin, WalksAreThoseOfTheParticles)
{
  on_ranks(check_walks);
}

TEST(PathsJoin, BoxesThatAreShearedFlippedAndGrow)
{
  on_ranks(check_deformed);
}

TEST(PathsJoin, FewParticlesOrNone)
{
  on_ranks(check_few);
}

/// A million crossings, from image counts as large, with the origin far away.
TEST(PathsJoin, AMillionCrossings)
{
  on_ranks(
    [](Communicator& ranks)
    {
      for (const walks::GridBox& box :
        { walks::straight_box(), walks::tilted_box(), walks::leaning_box() })
      {
        const walks::Run run =
          walks::make_run({ box }, { .frames = 6, .longest = grid << 20, .images = 1 << 20 }, 41);
        check_run(ranks, run, {}, true, { grid << 20, -grid / 16, 5 });
      }
    });
}

/// Any doubles: points are rounded once, from the vectors of the box, which have more bits.
TEST(PathsJoin, PointsAreRoundedOnce)
{
  HardCase hard("trajectories",
    "unwrapped places after 2^20 crossings of tilted boxes, minus a far origin", "half ulp", 1);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 300; ++trial)
  {
    const double away = trial % 3 == 0 ? 0 : std::pow(10, trial % 9);
    const Vector3 lo = { away + any(random), -away + any(random), any(random) };
    const Vector3 hi = { lo[0] + 3 + any(random), lo[1] + 3 + any(random),
      lo[2] + 2 + any(random) };
    Box box = trial % 2 == 0
      ? Box::from_bounds(lo, hi)
      : Box::from_tilted_bounds(lo, hi, any(random), any(random), any(random));
    box.boundary = "pp pp pp";
    PathJoin options;
    options.origin = { away + any(random), any(random), 0 };
    std::vector<PathFrame> frames(2);
    std::array<std::int64_t, 3> counts = {};
    for (PathFrame& frame : frames)
    {
      frame.loaded = true;
      frame.header.box = box;
      frame.has_images = true;
      frame.ids = { 7 };
      frame.points = { lo[0] + 1 + any(random), lo[1] + 1 + any(random), lo[2] + 1 + any(random) };
      for (std::size_t k = 0; k < 3; ++k)
      {
        const std::int64_t image = walks::any_of(random, 1 << 20);
        frame.images.push_back(image);
        counts[k] = image - counts[k];
      }
    }
    const Paths paths = join_alone(frames, options);
    for (std::size_t k = 0; k < 3; ++k)
    {
      Exact place = Exact(frames[1].points[k]) - Exact(options.origin[k]);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const Quad part =
          static_cast<Quad>(static_cast<double>(counts[axis])) * exact(box.vectors[axis][k]);
        place = place + Exact(part, absolute(part));
      }
      hard.add(2 * error_in_bounds(paths.points[3 + k], place));
    }
  }
}

/// Each rounds once a frame where a box grows under image counts that are not zero.
TEST(PathsJoin, DisplacementsInGrowingBoxes)
{
  HardCase hard("trajectories",
    "displacements over 1000 frames of a growing box from image counts of 1000: error by the "
    "largest place",
    "relative", 2e-13);
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> any(0, 1);
  std::vector<PathFrame> frames(1000);
  const std::vector<std::int64_t> images = { 1000, -900, 500 };
  for (std::size_t f = 0; f < frames.size(); ++f)
  {
    PathFrame& frame = frames[f];
    const double more = static_cast<double>(f) / 700;
    frame.loaded = true;
    frame.header.box = Box::from_tilted_bounds(
      { 0, 0, 0 }, { 3 + more, 3.1, 2 + more / 3 }, 0.1 + more / 4, 0.2, 0.1);
    frame.header.box.boundary = "pp pp pp";
    frame.has_images = true;
    frame.images = images;
    frame.ids = { 7 };
    frame.points = { any(random), any(random), any(random) };
  }
  const Paths paths = join_alone(frames);
  for (std::size_t f = 0; f < frames.size(); ++f)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto place_in = [&](std::size_t frame)
      {
        Quad place = static_cast<Quad>(frames[frame].points[k]);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          place += static_cast<Quad>(static_cast<double>(images[axis])) *
            exact(frames[frame].header.box.vectors[axis][k]);
        }
        return place;
      };
      const Quad expected = place_in(f) - place_in(0);
      const double found = paths.points[3 * f + k] - paths.points[k];
      hard.add(static_cast<double>(absolute(static_cast<Quad>(found) - expected)) / 4e3);
    }
  }
}

/// The box that the shapes of two frames belong to is found over a gap, too.
TEST(PathsJoin, GapsInAChangingBox)
{
  const auto boxes = walks::deformed_boxes(40);
  walks::Run run = walks::make_run(boxes, { .frames = 40, .longest = grid / 64 }, 24);
  for (std::size_t f = 1; f < run.frames.size(); ++f)
  {
    std::erase_if(run.frames[f],
      [f](const auto& one) { return (f + static_cast<std::size_t>(one.first) % 5) % 5 < 3; });
  }
  SerialCommunicator alone;
  check_run(alone, run, { .images = false }, false);
}

TEST(PathsJoin, StepsLongerThanAQuarterAreTold)
{
  Notices notices;
  // from 1: 2.4 on; to 5.0, 2.6 on; across the face, 2.6 on; 5 on, as far as it goes
  const std::vector<double> xs = { 1, 3.4, 6, 8.6, 1.2, 6.2 };
  std::vector<PathFrame> frames;
  for (const double x : xs)
  {
    frames.push_back(simple_frame({ 3 }, { x }));
  }
  join_alone(frames, {}, &notices);
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_EQ(to_string(notices[0]), to_string(note_long_steps(4)));
  EXPECT_NE(
    to_string(notices[0]).find("4 steps from frame to frame are longer than a quarter of a period"),
    std::string::npos);
  notices.clear();
  for (PathFrame& frame : frames)
  {
    frame.has_images = true;
    frame.images = { 0, 0, 0 };
  }
  EXPECT_EQ(xs_of(join_alone(frames, {}, &notices)), xs);
  EXPECT_TRUE(notices.empty());
  run_ranks(3,
    [&](Communicator& ranks)
    {
      std::vector<PathFrame> own = dealt(frames, by_frames, ranks);
      for (PathFrame& frame : own)
      {
        frame.has_images = false;
        frame.images.clear();
      }
      Notices said;
      join(own, {}, ranks, &said);
      ASSERT_EQ(said.size(), 1U);
      EXPECT_EQ(to_string(said[0]), to_string(note_long_steps(4)));
    });
}

/// Across a periodic face paths go on; along other axes, without a box and without flags they go back.
TEST(PathsJoin, OnlyPeriodicAxesHaveImages)
{
  std::vector<PathFrame> frames = { simple_frame({ 3 }, { 9 }), simple_frame({ 3 }, { 1 }) };
  EXPECT_EQ(xs_of(join_alone(frames)), (std::vector<double>{ 9, 11 }));
  for (PathFrame& frame : frames)
  {
    frame.header.box.boundary = "ff pp pp";
  }
  EXPECT_EQ(xs_of(join_alone(frames)), (std::vector<double>{ 9, 1 }));
  for (PathFrame& frame : frames)
  {
    frame.header.box = {};
    frame.header.has_box = false;
  }
  EXPECT_EQ(xs_of(join_alone(frames)), (std::vector<double>{ 9, 1 }));
}

/// A box that moves by more than half a period takes its particles along; along axes that are not periodic it does not.
TEST(PathsJoin, BoxesThatMove)
{
  std::vector<PathFrame> frames = { simple_frame({ 3 }, { 1 }), simple_frame({ 3 }, { 7.5 }),
    simple_frame({ 3 }, { 21 }) };
  for (std::size_t f = 0; f < frames.size(); ++f)
  {
    const double x = 6 * static_cast<double>(f);
    frames[f].header.box = Box::from_bounds({ x, x, 0 }, { x + 10, x + 10, 10 });
    frames[f].header.box.boundary = "pp ff ff";
  }
  Notices notices;
  const Paths paths = join_alone(frames, {}, &notices);
  EXPECT_EQ(xs_of(paths), (std::vector<double>{ 1, 7.5, 11 }));
  EXPECT_EQ(paths.points[7], 1);
  EXPECT_TRUE(notices.empty());
}

TEST(PathsJoin, UnwrappedPointsStay)
{
  std::vector<PathFrame> frames = { simple_frame({ 3 }, { 9 }), simple_frame({ 3 }, { 1 }),
    simple_frame({ 3 }, { 47 }) };
  for (PathFrame& frame : frames)
  {
    frame.coordinates = Coordinates::Unwrapped;
  }
  Notices notices;
  const Paths paths = join_alone(frames, { { 1, 0, 0 }, true, {} }, &notices);
  EXPECT_EQ(xs_of(paths), (std::vector<double>{ 8, 0, 46 }));
  EXPECT_EQ(paths.crossings, std::vector<std::int64_t>(9));
  EXPECT_TRUE(notices.empty());
}

/// Image counts that only some frames have: paths have no jumps of whole boxes.
TEST(PathsJoin, ImageCountsInSomeFrames)
{
  std::vector<PathFrame> frames = { simple_frame({ 3 }, { 8 }), simple_frame({ 3 }, { 9 }),
    simple_frame({ 3 }, { 1 }), simple_frame({ 3 }, { 2 }), simple_frame({ 3 }, { 9 }) };
  for (const std::size_t f : { 1U, 2U, 4U })
  {
    frames[f].has_images = true;
    frames[f].images = { f == 1 || f == 4 ? 5 : 6, 0, 0 };
  }
  EXPECT_EQ(xs_of(join_alone(frames)), (std::vector<double>{ 8, 9, 11, 12, 9 }));
}

/// Image counts, and rows, that only one rank has are those of none.
TEST(PathsJoin, ImageCountsThatARankLacks)
{
  const walks::Run run =
    walks::make_run({ walks::tilted_box() }, { .longest = walks::grid / 200 }, 77);
  const Paths expected = walks::paths_of(run, {}, false);
  for (const int lacks : { 0, 1 })
  {
    run_ranks(2,
      [&](Communicator& ranks)
      {
        std::vector<PathFrame> frames = dealt(walks::frames_of(run, {}), by_rows, ranks);
        for (PathFrame& frame : frames)
        {
          frame.has_images = frame.has_rows = ranks.rank() != lacks;
          frame.images.assign(frame.has_images ? 3 * frame.ids.size() : 0, 5); // wrong ones
          frame.rows.resize(frame.has_rows ? frame.ids.size() : 0);
        }
        expect_paths(join(std::move(frames), {}, ranks), expected, ranks);
      });
  }
}

TEST(PathsJoin, PlacesThatAreNoNumbers)
{
  const std::vector<PathFrame> frames = { simple_frame({ 3 }, { 9 }),
    simple_frame({ 3 }, { nothing }), simple_frame({ 3 }, { 9 }) };
  const std::vector<double> xs = xs_of(join_alone(frames));
  EXPECT_EQ(xs[0], 9);
  EXPECT_TRUE(std::isnan(xs[1]));
  EXPECT_EQ(xs[2], 9);
}

TEST(PathsJoin, NoFrame)
{
  on_ranks(
    [](Communicator& ranks)
    {
      const Paths paths = join({}, {}, ranks);
      EXPECT_TRUE(paths.headers.empty() && paths.ids.empty() && paths.places() == 0);
      EXPECT_EQ(paths.begins, std::vector<std::int64_t>{ 0 });
    });
}

TEST(PathsJoin, RepeatedIds)
{
  const std::string expected = "expected each id once in a frame, got id 4 in rows 10 and 30 of "
                               "timestep 50 (rows are counted from 0)";
  const std::vector<PathFrame> frames = { simple_frame({ 3, 4, 5 }, { 1, 2, 3 }),
    simple_frame({ 3, 4, 5, 4, 6, 4 }, { 1, 2, 3, 2, 5, 6 }) };
  EXPECT_EQ(error_of([&] { join_alone(frames); }), expected);
  for (const int size : { 2, 3, 5 })
  {
    for (const Deal& deal : { Deal(by_frames), Deal(by_rows), Deal(all_on_last) })
    {
      run_ranks(size,
        [&](Communicator& ranks)
        {
          const std::string error = error_of([&] { join(dealt(frames, deal, ranks), {}, ranks); });
          EXPECT_NE(error.find("got id 4 in rows "), std::string::npos) << error;
          EXPECT_NE(error.find(" of timestep 50"), std::string::npos) << error;
        });
    }
  }
  // who can name more does
  PathJoin options;
  std::vector<std::int64_t> asked;
  options.name_rows = [&](std::int64_t id, std::size_t frame)
  {
    asked = { id, static_cast<std::int64_t>(frame) };
    throw_repeated(id, 50, 17, 19, { "some.dump", 5, 0 });
  };
  EXPECT_EQ(error_of([&] { join_alone(frames, options); }),
    "some.dump:5: expected each id once in a frame, got id 4 in rows 17 and 19 of timestep 50 "
    "(rows are counted from 0)");
  EXPECT_EQ(asked, (std::vector<std::int64_t>{ 4, 1 }));
}

TEST(PathsJoin, ArraysThatFramesLack)
{
  std::vector<PathFrame> frames = { simple_frame({ 3 }, { 1 }), simple_frame({ 3, 5 }, { 1, 2 }),
    simple_frame({}, {}), simple_frame({ 5 }, { 2 }) };
  frames[0].arrays = { { "a", 1, true, { 7 } }, { "b", 0, true, {} } };
  frames[1].arrays = { { "a" }, { "b", 2, true, { 1, 2, 3, 4 } } };
  frames[2].arrays = { { "a" }, { "b" } };
  frames[3].arrays = { array_of({ 0.5 }), { "b" } };
  frames[3].arrays[0].name = "a";
  on_ranks(
    [&](Communicator& ranks)
    {
      for (const Deal& deal : { Deal(by_frames), Deal(by_rows), Deal(all_on_last) })
      {
        Paths all = join_alone(frames);
        expect_paths(join(dealt(frames, deal, ranks), {}, ranks), all, ranks);
      }
    });
  const Paths paths = join_alone(frames);
  EXPECT_FALSE(paths.arrays[0].integers); // of some frames doubles
  EXPECT_EQ(
    bits_of(values_of(paths.arrays[0])), bits_of(std::vector<double>{ 7, nothing, nothing, 0.5 }));
  EXPECT_TRUE(paths.arrays[1].integers);
  EXPECT_EQ(paths.arrays[1].words, (std::vector<std::int64_t>{ 0, 0, 1, 2, 3, 4, 0, 0 }));
}

TEST(PathsJoin, ArraysThatCannotBe)
{
  on_ranks(
    [&](Communicator& ranks)
    {
      std::vector<PathFrame> frames = { simple_frame({ 3 }, { 1 }), simple_frame({ 3 }, { 1 }) };
      frames[0].arrays = { { "b" } };
      frames[1].arrays = { { "b" } };
      EXPECT_EQ(error_of([&] { join(dealt(frames, by_frames, ranks), {}, ranks); }),
        "expected an array 'b' of the particles, got none in any frame");
      frames[0].arrays = { array_of({ 1 }) };
      frames[1].arrays = { array_of({ 1, 2 }, 2) };
      EXPECT_EQ(error_of([&] { join(dealt(frames, by_frames, ranks), {}, ranks); }),
        "expected as many numbers a particle in array 'a' in all frames, got 1 and 2");
      // without particles no array can be there
      frames = { simple_frame({}, {}) };
      frames[0].arrays = { { "b" } };
      const Paths paths = join(dealt(frames, by_frames, ranks), {}, ranks);
      EXPECT_EQ(paths.arrays.size(), 1U);
    });
}

TEST(PathsJoin, Cancelled)
{
  run_ranks(2,
    [](Communicator& ranks)
    {
      Stop stop(0);
      Progress go;
      Notices notices;
      EXPECT_THROW(join_frames(dealt({ simple_frame({ 3 }, { 1 }) }, by_frames, ranks), {}, ranks,
                     notices, ranks.rank() == 0 ? static_cast<Progress&>(stop) : go),
        Cancelled);
    });
}
