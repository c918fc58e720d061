// SPDX-License-Identifier: BSD-3-Clause
// Averages at points: the same bits for any order, threads and ranks; points and rows that are far away, broken or not there.
#include "made_points.h"
#include "made_rows.h"

#include "granular/averages/point_sources.h"
#include "granular/common/error.h"

#include "../support/thread_ranks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <mutex>
#include <random>
#include <string>
#include <vector>

using namespace granular;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

bool are_zero(const std::vector<std::uint64_t>& bits)
{
  return std::ranges::all_of(bits, [](std::uint64_t each) { return each == 0; });
}

PointAverageRequest some_request()
{
  return request_at_points(KernelShape::Gaussian, 0.15);
}

}

TEST(PointRows, AnyOrderAndThreadsGiveTheSameBits)
{
  const Box box = make_box();
  Scene scene = random_scene(400, 600, 80, lo, hi, 1, 0.2);
  const std::vector<double> points = random_points(700, lo, hi, 2, 0.2);
  const Bits first = bits_of(average_points_of(scene, points, &box, some_request()));
  EXPECT_GT(std::ranges::count_if(first, [](const auto& bits) { return !are_zero(bits); }), 500);
  std::mt19937_64 random(3);
  for (int threads = 1; threads <= 4; ++threads)
  {
    std::ranges::shuffle(scene.pairs, random);
    std::ranges::shuffle(scene.walls, random);
    for (std::size_t i = scene.particles.size() - 1; i > 0; --i)
    {
      const std::size_t other = random() % (i + 1);
      std::swap(scene.particles[i], scene.particles[other]);
      std::swap(scene.ids[i], scene.ids[other]);
    }
    EXPECT_EQ(bits_of(average_points_of(scene, points, &box, some_request(), threads)), first);
  }
}

/// Particles, contacts and points on any ranks, of which one has no points, or all are on one.
TEST(PointRows, AnyRanksGiveTheSameBits)
{
  const Box box = make_box();
  const Scene scene = random_scene(200, 300, 80, lo, hi, 4, 0.2);
  const std::vector<double> points = random_points(120, lo, hi, 5, 0.2);
  const Bits all = bits_of(average_points_of(scene, points, &box, some_request()));
  for (int size = 1; size <= 4; ++size)
  {
    for (const bool spread : { true, false })
    {
      std::size_t seen = 0;
      std::mutex lock;
      run_ranks(size,
        [&](Communicator& ranks)
        {
          std::mt19937_64 random(6);
          const auto is_here = [&]
          {
            return random() % static_cast<std::uint64_t>(ranks.size()) ==
              static_cast<std::uint64_t>(ranks.rank());
          };
          const Scene part = part_of(scene, is_here);
          std::vector<double> own;
          Bits expected;
          for (std::size_t i = 0; i < all.size(); ++i)
          {
            const int owner =
              spread ? static_cast<int>(i % static_cast<std::size_t>(size)) : size - 1;
            if (owner == ranks.rank())
            {
              own.insert(own.end(), points.begin() + static_cast<std::ptrdiff_t>(3 * i),
                points.begin() + static_cast<std::ptrdiff_t>(3 * i + 3));
              expected.push_back(all[i]);
            }
          }
          const Bits found = bits_of(average_points_of(part, own, &box, some_request(), ranks));
          EXPECT_TRUE(found == expected) << ranks.rank() << " of " << size;
          const std::scoped_lock guard(lock);
          seen += found.size();
        });
      EXPECT_EQ(seen, all.size());
    }
  }
}

/// On one rank alone: particles are on others.
TEST(PointRows, ParticlesMayBeOnOtherRanksThanPoints)
{
  const Scene scene = random_scene(60, 90, 10, lo, hi, 7, 0.2);
  const std::vector<double> points = random_points(40, lo, hi, 8);
  const Bits all = bits_of(average_points_of(scene, points, nullptr, some_request()));
  run_ranks(3,
    [&](Communicator& ranks)
    {
      const bool has_points = ranks.rank() == 0;
      const Scene none;
      const Bits found = bits_of(average_points_of(ranks.rank() == 2 ? scene : none,
        has_points ? points : std::vector<double>(), nullptr, some_request(), ranks));
      EXPECT_TRUE(found == (has_points ? all : Bits()));
    });
}

TEST(PointRows, PointsThatAreNoneHaveZeros)
{
  const Scene scene = random_scene(60, 90, 10, lo, hi, 9, 0.2);
  const std::vector<double> points = random_points(20, lo, hi, 10);
  const Bits expected = bits_of(average_points_of(scene, points, nullptr, some_request()));
  std::vector<double> with;
  for (std::size_t i = 0; i < 20; ++i)
  {
    with.insert(with.end(), { points[3 * i], points[3 * i + 1], points[3 * i + 2] });
    Vector3 wrong = { 0, 1, 2.5 };
    wrong[i % 3] = i % 2 == 0 ? not_a_number : i % 4 == 1 ? infinity : -infinity;
    with.insert(with.end(), wrong.begin(), wrong.end());
  }
  const Box box = make_box(); // of what is nowhere there are no images
  for (const Box* const images : { static_cast<const Box*>(nullptr), &box })
  {
    const Bits plain = bits_of(average_points_of(scene, points, images, some_request()));
    const Bits found = bits_of(average_points_of(scene, with, images, some_request()));
    for (std::size_t i = 0; i < 20; ++i)
    {
      EXPECT_EQ(found[2 * i], plain[i]);
      EXPECT_TRUE(are_zero(found[2 * i + 1]));
    }
  }
  const std::vector<double> nowhere(30, not_a_number);
  for (const auto& bits : bits_of(average_points_of(scene, nowhere, &box, some_request())))
  {
    EXPECT_TRUE(are_zero(bits));
  }
  EXPECT_EQ(average_points_of(scene, {}, &box, some_request()).cells.count(), 0);
}

TEST(PointRows, PointsFarAwayHaveZerosAndTroubleNobody)
{
  const Scene scene = random_scene(60, 90, 10, lo, hi, 11, 0.2);
  std::vector<double> points = random_points(20, lo, hi, 12);
  const Bits expected = bits_of(average_points_of(scene, points, nullptr, some_request()));
  for (const double far : { 1e3, 1e9, 1e100, 1e308 })
  {
    std::vector<double> with = points;
    with.insert(with.end(), { far, 0, 0, -far, far, -far, 0, -far, 2.5 });
    const Bits found = bits_of(average_points_of(scene, with, nullptr, some_request()));
    ASSERT_EQ(found.size(), 23U);
    for (std::size_t i = 0; i < 23; ++i)
    {
      EXPECT_TRUE(i < 20 ? found[i] == expected[i] : are_zero(found[i])) << far << " " << i;
    }
  }
}

TEST(PointRows, TooManyImagesAreAnErrorOnAllRanks)
{
  const Box box = make_box();
  const Scene scene = random_scene(60, 90, 10, lo, hi, 13, 0.2);
  const std::vector<double> far = { 1e9, 0, 0, -1e9, 0, 0 };
  EXPECT_THROW(average_points_of(scene, far, &box, some_request()), LimitError);
  // a line from a particle to an image of it, as far as many boxes
  Scene long_line = scene;
  long_line.pairs[5].id2 = long_line.pairs[5].id1;
  long_line.pairs[5].to[0] += 1e9;
  const std::vector<double> points = random_points(10, lo, hi, 14);
  EXPECT_THROW(average_points_of(long_line, points, &box, some_request()), LimitError);
  run_ranks(3,
    [&](Communicator& ranks)
    {
      const Scene none;
      EXPECT_THROW(
        average_points_of(ranks.rank() == 1 ? long_line : none,
          ranks.rank() == 2 ? points : std::vector<double>(), &box, some_request(), ranks),
        LimitError);
    });
  EXPECT_NO_THROW(average_points_of(long_line, points, nullptr, some_request()));
}

TEST(PointRows, BrokenParticlesAreLeftOutAndCounted)
{
  Scene scene = random_scene(60, 0, 0, lo, hi, 15);
  const std::vector<double> points = random_points(20, lo, hi, 16);
  const Bits expected = bits_of(average_points_of(scene, points, nullptr, some_request()));
  for (int i = 0; i < 5; ++i)
  {
    scene.particles.push_back(scene.particles[0]);
    scene.ids.push_back(1000 + i);
  }
  scene.particles[60].x[1] = not_a_number;
  scene.particles[61].v[0] = infinity;
  scene.particles[62].mass = -1;
  scene.particles[63].radius = not_a_number;
  scene.particles[64].x[0] = 1e300;
  const EulerAverages found = average_points_of(scene, points, nullptr, some_request());
  EXPECT_EQ(found.broken, 5);
  EXPECT_EQ(bits_of(found), expected);
  run_ranks(2,
    [&](Communicator& ranks)
    {
      const Scene none;
      const EulerAverages part =
        average_points_of(ranks.rank() == 1 ? scene : none, points, nullptr, some_request(), ranks);
      EXPECT_EQ(part.broken, 5);
      EXPECT_EQ(bits_of(part), expected);
    });
}

TEST(PointRows, FieldsThatNobodyWantsAreEmpty)
{
  const Scene scene = random_scene(60, 90, 10, lo, hi, 17, 0.2);
  const std::vector<double> points = random_points(10, lo, hi, 18);
  const EulerAverages all = average_points_of(scene, points, nullptr, some_request());
  PointAverageRequest request = some_request();
  request.tensors = false;
  request.pressure = false;
  request.fields = {};
  request.fields.density = true;
  const EulerAverages few = average_points_of(scene, points, nullptr, request);
  EXPECT_EQ(few.fields.density, all.fields.density);
  EXPECT_EQ(few.cells.velocities, all.cells.velocities);
  EXPECT_EQ(few.cells.pressure, std::vector<double>(10));
  EXPECT_TRUE(few.cells.normal_stress.empty() && few.fields.contact_normal.empty());
  EXPECT_TRUE(few.fields.coordination.empty() && few.fields.fabric.empty());
  EXPECT_TRUE(few.fields.momentum.empty() && few.fields.temperature.empty());
  // without contacts there is nothing of them
  SerialCommunicator alone;
  Notices notices;
  Progress progress;
  const SceneFrame frame(scene, nullptr);
  const EulerAverages without = average_at_points(
    frame.view(), points, nullptr, some_request(), alone, Executor(1), notices, progress);
  EXPECT_TRUE(without.fields.contact_normal.empty() && without.fields.coordination.empty());
  EXPECT_EQ(without.cells.normal_stress, all.cells.normal_stress);
  EXPECT_TRUE(notices.empty());
}

TEST(Bins, HaveAllThatMayReachAPoint)
{
  std::mt19937_64 random(19);
  std::uniform_real_distribution<double> unit(0, 1);
  for (const double edge : { 1e-9, 0.05, 0.3, 100.0 })
  {
    std::vector<Extent> things;
    for (int i = 0; i < 300; ++i)
    {
      const Vector3 place = { 4 * unit(random) - 2, 5 * unit(random) - 1, 3 * unit(random) + 1 };
      things.push_back(Extent{ place, place }.grown(0.3 * unit(random)));
    }
    const Bins bins({ lo, hi }, edge, things);
    for (int n = 0; n < 500; ++n)
    {
      Vector3 point;
      for (std::size_t k = 0; k < 3; ++k)
      {
        point[k] =
          n % 7 == 0 ? (n % 2 == 0 ? lo[k] : hi[k]) : lo[k] + (hi[k] - lo[k]) * unit(random);
      }
      const auto near = bins.near(point);
      EXPECT_TRUE(std::ranges::is_sorted(near));
      for (std::uint32_t i = 0; i < things.size(); ++i)
      {
        const bool reaches = things[i].meets({ point, point });
        EXPECT_TRUE(!reaches || std::ranges::count(near, i) == 1);
      }
    }
    EXPECT_TRUE(bins.near({ 1.01, 1, 2.5 }).empty());
    EXPECT_TRUE(bins.near({ 0, not_a_number, 2.5 }).empty());
  }
  EXPECT_TRUE(Bins(Extent(), 1, {}).near({ 0, 0, 0 }).empty());
}
