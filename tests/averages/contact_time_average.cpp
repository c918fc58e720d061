// SPDX-License-Identifier: BSD-3-Clause
// Averages over time of contacts and of chosen fields, against those of all frames at once.
#include "made_touches.h"

#include "granular/averages/time_average.h"
#include "granular/common/error.h"

#include "../support/hard_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <vector>

using namespace granular;

namespace
{
const EulerGrid grid = { { -1, 0, 2 }, { 1, 3, 3 }, { 4, 3, 3 } };

/// Frames with other particles and contacts each, one without contacts and one without anything.
std::vector<Scene> some_frames()
{
  std::vector<Scene> frames = { random_scene(40, 60, 9, grid.lo, grid.hi, 1),
    random_scene(10, 5, 0, grid.lo, grid.hi, 2), random_scene(25, 4, 0, grid.lo, grid.hi, 3), {},
    random_scene(60, 200, 20, grid.lo, grid.hi, 4) };
  frames[2].pairs.clear();
  return frames;
}

/// All particles and contacts of the frames as one set.
Scene together(const std::vector<Scene>& frames)
{
  Scene all;
  for (const Scene& frame : frames)
  {
    const auto before = static_cast<std::int64_t>(all.particles.size());
    for (std::size_t i = 0; i < frame.particles.size(); ++i)
    {
      all.particles.push_back(frame.particles[i]);
      all.ids.push_back(before + frame.ids[i]);
    }
    const auto add = [&](const std::vector<Touch>& from, std::vector<Touch>& to)
    {
      for (Touch touch : from)
      {
        touch.id1 += before;
        touch.id2 += before;
        to.push_back(touch);
      }
    };
    add(frame.pairs, all.pairs);
    add(frame.walls, all.walls);
  }
  return all;
}

TimeAverage over_time(const std::vector<Scene>& frames, const EulerAverageRequest& request)
{
  TimeAverage time;
  for (const Scene& frame : frames)
  {
    time.add(average_contacts_of(frame, nullptr, request));
  }
  EXPECT_EQ(time.frames(), static_cast<std::int64_t>(frames.size()));
  return time;
}

/// Those over the volume of a cell, of which there is one in each frame.
bool is_density(std::string_view name)
{
  return name == "density" || name == "momentum" || name == "sigma_contact" ||
    name == "tau_contact";
}

std::vector<EulerAverageRequest> some_requests()
{
  std::vector<EulerAverageRequest> requests = { request_of_contacts(grid, CellWeights::Centre),
    request_of_contacts(grid, CellWeights::Overlap),
    request_of_contacts(grid, CellWeights::Kernel, KernelShape::Gaussian, 0.4),
    request_of_contacts(grid, CellWeights::Kernel, KernelShape::Lucy, 0.7, KernelBounds::Inside) };
  return requests;
}
}

TEST(ContactTimeAverage, IsThatOfAllFramesAtOnce)
{
  HardCase hard("averages in time",
    "fields of contacts, against those of all frames at once: error of the largest value", "1",
    1e-13);
  const std::vector<Scene> frames = some_frames();
  for (const EulerAverageRequest& request : some_requests())
  {
    const EulerFields found = over_time(frames, request).fields();
    const EulerFields all = average_contacts_of(together(frames), nullptr, request).fields;
    for (const EulerField& field : euler_fields)
    {
      const std::vector<double>& values = found.*field.values;
      std::vector<double> expected = all.*field.values;
      ASSERT_EQ(values.size(), expected.size()) << field.name;
      const double frames_count = is_density(field.name) ? static_cast<double>(frames.size()) : 1;
      double largest = 0;
      for (double& value : expected)
      {
        value /= frames_count;
        largest = std::max(largest, std::abs(value));
      }
      EXPECT_TRUE(expected.empty() || largest > 0) << field.name;
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        EXPECT_NEAR(values[i], expected[i], 1e-13 * largest) << field.name;
        hard.add(std::abs(values[i] - expected[i]) / largest);
      }
    }
  }
}

TEST(ContactTimeAverage, OfOneFrameIsThatFrame)
{
  const Scene scene = random_scene(40, 60, 9, grid.lo, grid.hi, 5);
  for (const EulerAverageRequest& request : some_requests())
  {
    const EulerAverages alone = average_contacts_of(scene, nullptr, request);
    const EulerFields fields = over_time({ scene }, request).fields();
    for (const EulerField& field : euler_fields)
    {
      const std::vector<double>& found = fields.*field.values;
      const std::vector<double>& expected = alone.fields.*field.values;
      ASSERT_EQ(found.size(), expected.size()) << field.name;
      for (std::size_t i = 0; i < found.size(); ++i)
      {
        EXPECT_NEAR(found[i], expected[i], 1e-15 * std::abs(expected[i])) << field.name;
      }
    }
  }
}

TEST(ContactTimeAverage, TheMeanVelocityOfAllFramesIsWhatFluctuationsAreOf)
{
  EulerAverageRequest request =
    request_of_contacts({ { 0, 0, 0 }, { 1, 1, 1 }, { 1, 1, 1 } }, CellWeights::Centre);
  std::vector<Scene> frames(3);
  for (std::size_t i = 0; i < 3; ++i)
  {
    frames[i].particles = { { { 0.5, 0.5, 0.5 }, { static_cast<double>(i), 0, 0 }, 0.1, 2 } };
    frames[i].ids = { 1 };
  }
  const EulerFields fields = over_time(frames, request).fields();
  EXPECT_DOUBLE_EQ(fields.temperature[0], (1.0 + 0 + 1) / 3 / 3);
  EXPECT_EQ(fields.density[0], 2);
  EXPECT_EQ(fields.momentum[0], 2);
  EXPECT_EQ(fields.coordination[0], 0);
}

/// Their mean would be wrong: frames without forces are no frames without stress.
TEST(ContactTimeAverage, FramesWithAndWithoutForcesHaveNoMean)
{
  const EulerAverageRequest request = request_of_contacts(grid, CellWeights::Centre);
  std::vector<Scene> frames = some_frames();
  for (const unsigned without : { 0U, 1U, 4U })
  {
    std::vector<Scene> mixed = frames;
    mixed[without].forces = false;
    EXPECT_THROW(over_time(mixed, request), Error) << without;
  }
  for (Scene& frame : frames)
  {
    frame.forces = false;
  }
  EXPECT_TRUE(over_time(frames, request).fields().contact_normal.empty());
  std::rotate(frames.begin(), frames.begin() + 2, frames.end()); // one without contacts first
  EXPECT_TRUE(over_time(frames, request).fields().contact_normal.empty());
}

TEST(ContactTimeAverage, FieldsThatNobodyWantsAreEmpty)
{
  EulerAverageRequest request = request_of_contacts(grid, CellWeights::Overlap);
  request.fields = {};
  request.fields.density = true;
  const std::vector<Scene> frames = some_frames();
  const EulerFields fields = over_time(frames, request).fields();
  EXPECT_EQ(fields.density.size(), 36U);
  EXPECT_EQ(fields.contact_normal.size(), 108U);
  EXPECT_TRUE(fields.momentum.empty() && fields.temperature.empty());
  EXPECT_TRUE(fields.coordination.empty() && fields.fabric.empty());
  EXPECT_TRUE(TimeAverage().fields() == EulerFields());
}
