// SPDX-License-Identifier: BSD-3-Clause
// Particles of two frames compared: displacements in 113 bits, over ranks, and what is refused.
#include "granular/paths/compare_particles.h"

#include "granular/particles/frame_view.h"

#include "../support/error_of.h"
#include "../support/hard_case.h"
#include "../support/quad.h"
#include "../support/thread_ranks.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

using namespace granular;

namespace
{
using Id = std::int64_t;
using Values = std::vector<double>;
constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Particle
{
  Id id = 0;
  std::array<double, 3> x = {};
  std::array<std::int32_t, 3> image = {};
  double v = 0;
  unsigned char ghost = 0;
};

/// Particles as the arrays of one rank; without any it knows nothing.
struct Frame
{
  explicit Frame(const std::vector<Particle>& particles, const Box& box = {}, bool images = true)
  {
    for (const Particle& one : particles)
    {
      ids.push_back(one.id);
      points.insert(points.end(), one.x.begin(), one.x.end());
      counts.insert(counts.end(), one.image.begin(), one.image.end());
      v.push_back(one.v);
      ghosts.push_back(one.ghost);
    }
    view.rows = std::ssize(ids);
    view.has_box = box.boundary.size() > 0;
    view.header.box = box;
    if (view.rows > 0)
    {
      view.points = view_rows("points", ValueType::Float64, points.data(), 3);
      view.arrays = { view_rows("id", ValueType::Int64, ids.data()),
        view_rows("v", ValueType::Float64, v.data()) };
      view.ghosts = ghosts.data();
    }
    if (images && view.rows > 0)
    {
      view.arrays.push_back(view_rows("image", ValueType::Int32, counts.data(), 3));
    }
  }
  Frame(const Frame&) = delete;
  void operator=(const Frame&) = delete;

  std::vector<Id> ids;
  Values points;
  std::vector<std::int32_t> counts;
  Values v;
  std::vector<unsigned char> ghosts;
  FrameView view;
};

ComparedParticles compare(const FrameView& current, const FrameView& reference,
  const std::vector<std::string>& differences, Communicator& ranks, int threads = 1)
{
  Progress progress;
  return compare_particles(current, reference, { differences, threads }, ranks, progress);
}

ComparedParticles compare_alone(const FrameView& current, const FrameView& reference,
  const std::vector<std::string>& differences = {})
{
  SerialCommunicator alone;
  return compare(current, reference, differences, alone);
}

Values numbers(const Block& block)
{
  const auto* const first = static_cast<const double*>(block.data());
  return { first, first + block.bytes() / sizeof(double) };
}

Box make_box(double length, const std::string& boundary)
{
  Box box = Box::from_bounds({ 0, 0, 0 }, { length, length, length });
  box.boundary = boundary;
  return box;
}

double random_number(std::mt19937_64& random, double most)
{
  return std::uniform_real_distribution<double>(-most, most)(random);
}

/// Edges of any length and tilt, somewhere.
Box random_box(std::mt19937_64& random)
{
  const auto length = [&] { return std::exp(random_number(random, 3)); };
  const Vector3 lo = { random_number(random, 1e3), random_number(random, 10), 0 };
  Box box = Box::from_edges(lo,
    { Vector3{ length(), 0, 0 }, Vector3{ random_number(random, 20), length(), 0 },
      Vector3{ random_number(random, 20), random_number(random, 20), length() } });
  box.boundary = "pp pp pp";
  return box;
}

Particle random_particle(Id id, int most_images, std::mt19937_64& random)
{
  Particle one;
  one.id = id;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    one.x[axis] = random_number(random, 30);
    one.image[axis] =
      static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(2 * most_images + 1)) -
      most_images;
  }
  one.v = random_number(random, 1);
  return one;
}

Exact unwrapped(const Particle& one, const Box& box, std::size_t axis)
{
  Exact sum(one.x[axis]);
  for (std::size_t i = 0; i < 3; ++i)
  {
    const Twofold& edge = box.vectors[i][axis];
    sum = sum + Exact(static_cast<double>(one.image[i])) * (Exact(edge.hi) + Exact(edge.lo));
  }
  return sum;
}

std::vector<Particle> part_of(const std::vector<Particle>& all, int step, int rank, int ranks)
{
  std::vector<Particle> part;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (static_cast<int>(i) / step % ranks == rank)
    {
      part.push_back(all[i]);
    }
  }
  return part;
}
}

TEST(CompareParticles, DisplacementsAreRoundedOnce)
{
  HardCase hard("displacements",
    "tilted boxes that change, up to 2^20 images: error over its bound", "bounds", 0.51);
  std::mt19937_64 random(21);
  for (int trial = 0; trial < 200; ++trial)
  {
    const Box box = random_box(random);
    const Box old_box = random_box(random);
    const int most = trial % 2 == 0 ? 1 << 20 : 2;
    std::vector<Particle> now;
    std::vector<Particle> before;
    for (Id id = 0; id < 20; ++id)
    {
      now.push_back(random_particle(id, most, random));
      before.push_back(random_particle(19 - id, most, random));
    }
    const Frame current(now, box);
    const Frame reference(before, old_box);
    const ComparedParticles found = compare_alone(current.view, reference.view);
    EXPECT_TRUE(found.unwrapped);
    EXPECT_EQ(found.far, 0);
    const Values displacements = numbers(found.displacements);
    for (std::size_t i = 0; i < 60; ++i)
    {
      const Exact exact =
        unwrapped(now[i / 3], box, i % 3) - unwrapped(before[19 - i / 3], old_box, i % 3);
      hard.add(error_in_bounds(displacements[i], exact));
    }
  }
}

/// Origins that differ, points that are unwrapped in one frame: the displacement is the same.
TEST(CompareParticles, FormsOfPointsDoNotMatter)
{
  const Box box = make_box(10, "pp pp pp");
  const Frame absolute({ { 7, { 9, 1, 5 }, { 2, -1, 0 }, 1 } }, box);
  Frame unwrapped({ { 7, { 29, -9, 5 }, {}, 1 } }, box, false);
  unwrapped.view.coordinates = Coordinates::Unwrapped;
  Frame moved({ { 7, { 9 - 512, 1, 5 + 64 }, { 2, -1, 0 }, 1 } }, box);
  moved.view.point_origin = { 512, 0, -64 };
  Frame scaled({ { 7, { 0.875, 0.125, 0.5 }, { 2, -1, 0 }, 1 } }, box);
  scaled.view.coordinates = Coordinates::Scaled;
  const Frame start({ { 7, { 1, 2, 3 }, {}, 1 } }, box);
  for (const Frame* frame :
    { &absolute, &static_cast<const Frame&>(unwrapped), &static_cast<const Frame&>(moved) })
  {
    EXPECT_EQ(
      numbers(compare_alone(frame->view, start.view).displacements), (Values{ 28, -11, 2 }));
    EXPECT_EQ(
      numbers(compare_alone(frame->view, absolute.view).displacements), (Values{ 0, 0, 0 }));
    EXPECT_TRUE(compare_alone(frame->view, start.view).unwrapped);
  }
  EXPECT_EQ(
    numbers(compare_alone(scaled.view, start.view).displacements), (Values{ 27.75, -10.75, 2 }));
}

/// The nearest of 11^3 images in tilted boxes; far ones are counted.
TEST(CompareParticles, WithoutImagesTheNearestIsTaken)
{
  std::mt19937_64 random(22);
  std::int64_t far = 0;
  for (int trial = 0; trial < 40; ++trial)
  {
    Box box = Box::from_edges({ 0, 0, 0 },
      { Vector3{ 10, 0, 0 }, Vector3{ random_number(random, 5), 8, 0 },
        Vector3{ random_number(random, 5), random_number(random, 4), 6 } });
    box.boundary = trial % 2 == 0 ? "pp pp pp" : "pp ff pp";
    std::vector<Particle> now;
    std::vector<Particle> before;
    for (Id id = 0; id < 20; ++id)
    {
      now.push_back(random_particle(id, 1, random));
      before.push_back(random_particle(id, 1, random));
    }
    const Frame current(now, box, false);
    const Frame reference(before, make_box(3, "pp pp pp"));
    const ComparedParticles found = compare_alone(current.view, reference.view);
    EXPECT_FALSE(found.unwrapped);
    far += found.far;
    const Values displacements = numbers(found.displacements);
    for (std::size_t i = 0; i < 20; ++i)
    {
      double least = std::numeric_limits<double>::infinity();
      for (int number = 0; number < 29 * 29 * 29; ++number)
      {
        const std::array<int, 3> n = { number % 29 - 14, trial % 2 == 0 ? number / 29 % 29 - 14 : 0,
          number / 841 - 14 };
        double square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const double length = now[i].x[axis] - before[i].x[axis] +
            n[0] * box.vectors[0][axis].value() + n[1] * box.vectors[1][axis].value() +
            n[2] * box.vectors[2][axis].value();
          square += length * length;
        }
        least = std::min(least, square);
      }
      const double* const d = displacements.data() + 3 * i;
      EXPECT_NEAR(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], least, 1e-12 * (1 + least));
    }
  }
  EXPECT_GT(far, 500);
}

TEST(CompareParticles, FarIsMoreThanAQuarterOfAPeriod)
{
  const Frame start({ { 1 }, { 2 }, { 3 }, { 4 } }, make_box(8, "pp pp ff"), false);
  const Frame current({ { 1, { 2, -2, 9 } }, { 2, { 2.125, 0, 0 } }, { 3, { 6, 0, 0 } },
                        { 4, { 0, 13.5, 0 }, {}, 0, 1 } },
    make_box(8, "pp pp ff"), false);
  const ComparedParticles found = compare_alone(current.view, start.view);
  EXPECT_EQ(found.far, 1); // 2; 3 has gone back by 2, and ghosts do not count
  EXPECT_EQ(numbers(found.displacements), (Values{ 2, -2, 9, 2.125, 0, 0, -2, 0, 0, 0, -2.5, 0 }));
  const Frame boxless({ { 1, { 20, -2, 9 } } }, {}, false);
  const Frame boxless_start({ { 1 } }, {}, false);
  EXPECT_EQ(
    numbers(compare_alone(boxless.view, boxless_start.view).displacements), (Values{ 20, -2, 9 }));
  // without a box of its own the current frame has that of the reference frame
  EXPECT_EQ(numbers(compare_alone(boxless.view, start.view).displacements), (Values{ 4, -2, 9 }));
}

namespace
{
/// Compares particles that are spread over ranks, each frame in its way, with a std::map of all.
void check_spread(Communicator& ranks, const std::vector<Particle>& now,
  const std::vector<Particle>& before, int step, int old_step)
{
  const Box box = make_box(64, "pp pp pp");
  const auto own = part_of(now, step, ranks.rank(), ranks.size());
  const auto old = part_of(before, old_step, ranks.rank(), ranks.size());
  Frame current(own, own.empty() ? Box{} : box);
  Frame reference(old, old.empty() ? Box{} : box);
  share_header(current.view, ranks);
  share_header(reference.view, ranks);
  std::map<Id, Particle> known;
  std::map<Id, int> alive;
  for (const Particle& one : before)
  {
    if (one.ghost == 0)
    {
      known.emplace(one.id, one);
    }
  }
  for (const Particle& one : now)
  {
    alive[one.id] += one.ghost == 0 ? 1 : 0;
  }
  for (const int threads : { 1, 3 })
  {
    const ComparedParticles found =
      compare(current.view, reference.view, { "v", "v" }, ranks, threads);
    Values displacements;
    Values differences;
    std::vector<Change> changes;
    for (const Particle& one : own)
    {
      const auto old_one = known.find(one.id);
      const bool kept = old_one != known.end();
      changes.push_back(kept ? Change::Kept : Change::New);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        displacements.push_back(kept ? one.x[axis] - old_one->second.x[axis] +
              64. * (one.image[axis] - old_one->second.image[axis])
                                     : none);
      }
      differences.push_back(kept ? one.v - old_one->second.v : none);
    }
    std::vector<Id> lost;
    for (std::size_t i = 0; i < old.size(); ++i)
    {
      if (old[i].ghost == 0 && alive[old[i].id] == 0)
      {
        lost.push_back(static_cast<Id>(i));
      }
    }
    EXPECT_EQ(found.changes, changes);
    EXPECT_EQ(found.lost, lost);
    const auto same = [](const Block& block, const Values& expected)
    {
      return block.bytes() == expected.size() * 8 &&
        (expected.empty() || std::memcmp(block.data(), expected.data(), block.bytes()) == 0);
    };
    EXPECT_TRUE(same(found.displacements, displacements));
    ASSERT_EQ(found.differences.size(), 1U);
    EXPECT_EQ(found.differences[0].name, "v_difference");
    EXPECT_TRUE(same(found.differences[0].values, differences));
  }
}

/// Multiples of 1/1024, of which differences are exact; ids of any size.
std::vector<Particle> make_particles(Id first, Id count, std::mt19937_64& random)
{
  std::vector<Particle> particles;
  for (Id i = first; i < first + count; ++i)
  {
    const Id wide = i % 3 == 0 ? std::numeric_limits<Id>::min() + i : i % 3 == 1 ? -i : i * 7919;
    Particle one = random_particle(wide, 100, random);
    for (double& x : one.x)
    {
      x = std::nearbyint(x * 1024) / 1024;
    }
    particles.push_back(one);
  }
  std::ranges::shuffle(particles, random);
  return particles;
}
}

TEST(CompareParticles, AnyRanksAndThreads)
{
  std::mt19937_64 random(23);
  auto now = make_particles(0, 300, random);
  auto before = make_particles(100, 350, random);
  for (std::size_t i = 0; i < 20; ++i) // copies of particles of other ranks, and of none
  {
    for (auto* const particles : { &now, &before })
    {
      Particle copy = (*particles)[7 * i];
      copy.ghost = 1;
      copy.id += i < 10 ? 0 : 5'000'000;
      particles->insert(particles->begin() + static_cast<std::ptrdiff_t>(11 * i), copy);
    }
  }
  const auto check = [&](Communicator& ranks)
  {
    check_spread(ranks, now, before, 1, 3);
    check_spread(ranks, now, before, 1000, 1);
    check_spread(ranks, now, before, 200, 1000);
    check_spread(ranks, now, {}, 1, 1);
    check_spread(ranks, {}, before, 1, 7);
    check_spread(ranks, {}, {}, 1, 1);
  };
  SerialCommunicator alone;
  check(alone);
  for (const int ranks : { 1, 2, 3, 5 })
  {
    SCOPED_TRACE(ranks);
    run_ranks(ranks, check);
  }
}

TEST(CompareParticles, RepeatedIdsAreRefusedWithTheirRows)
{
  const std::vector<Particle> good = { { 1 }, { 2 }, { 3 }, { 4 }, { 5 }, { 6 } };
  const std::vector<Particle> bad = { { 1 }, { 2 }, { 3 }, { 4 }, { 2 }, { 3 } };
  for (const int size : { 1, 2, 3 })
  {
    run_ranks(size,
      [&](Communicator& ranks)
      {
        const Frame one(part_of(good, 6 / size, ranks.rank(), size));
        const Frame two(part_of(bad, 6 / size, ranks.rank(), size));
        const std::string text = ", got id 2 in rows 1 and 4 (the first is 0)";
        EXPECT_EQ(error_of([&] { compare(two.view, one.view, {}, ranks); }),
          "expected each id once among the particles" + text);
        EXPECT_EQ(error_of([&] { compare(one.view, two.view, {}, ranks); }),
          "expected each id once among the particles of the reference frame" + text);
      });
  }
}

TEST(CompareParticles, ArraysThatDoNotFitAreRefused)
{
  const Box box = make_box(1, "pp pp pp");
  const Frame good({ { 1 }, { 2 } }, box);
  Frame other({ { 1 }, { 2 } }, box);
  const auto refusal = [&](const std::string& name)
  { return error_of([&] { compare_alone(good.view, other.view, { name }); }); };
  EXPECT_EQ(refusal("u"), "expected an array 'u' of the particles, got none");
  other.view.arrays[1] = view_rows("v", ValueType::Float64, other.points.data(), 3);
  EXPECT_EQ(refusal("v"),
    "expected as many numbers a particle in array 'v' of both frames, got 1 and 3 in the reference "
    "frame");
  const std::vector<std::string> texts = { "a", "b" };
  other.view.arrays[1] = view_rows("v", ValueType::Text, texts.data());
  EXPECT_EQ(refusal("v"), "expected numbers in array 'v' of the particles, got texts");
  other.view.arrays.erase(other.view.arrays.begin());
  EXPECT_EQ(error_of([&] { compare_alone(good.view, other.view); }),
    "expected an array 'id' of the particles of the reference frame, got none");
  EXPECT_EQ(error_of([&] { compare_alone(other.view, good.view); }),
    "expected an array 'id' of the particles, got none");
}

/// Counts that are no integers, or not three, are not trusted.
TEST(CompareParticles, ImagesAreThreeIntegers)
{
  const Box box = make_box(8, "pp pp pp");
  Frame current({ { 1, { 1, 1, 1 }, { 1, 0, 0 } } }, box);
  const Frame reference({ { 1 } }, box);
  EXPECT_EQ(
    numbers(compare_alone(current.view, reference.view).displacements), (Values{ 9, 1, 1 }));
  current.view.arrays[2].type = ValueType::Float32;
  EXPECT_EQ(
    numbers(compare_alone(current.view, reference.view).displacements), (Values{ 1, 1, 1 }));
  current.view.arrays[2] = view_rows("image", ValueType::Int32, current.counts.data());
  EXPECT_EQ(
    numbers(compare_alone(current.view, reference.view).displacements), (Values{ 1, 1, 1 }));
}
