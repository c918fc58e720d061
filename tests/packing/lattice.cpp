// SPDX-License-Identifier: BSD-3-Clause
// Lattices and chains: counts and places from arithmetic, and no overlap: squares of distances against squares of sums of
// radii, in 113 bits, which hold differences and squares of the doubles here.
#include "../support/hard_case.h"
#include "../support/packings.h"
#include "../support/quad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

namespace
{
using granular::Arrangement;
using granular::PackingRequest;
using granular::Vector3;

constexpr Arrangement arrangements[] = { Arrangement::SimpleCubic, Arrangement::FaceCentredCubic,
  Arrangement::Chain };

PackingRequest on(Arrangement arrangement, const granular::Box& box, const std::string& boundary,
  double radius = 0.5)
{
  PackingRequest request;
  request.arrangement = arrangement;
  request.box = box;
  request.boundary = boundary;
  request.radii = one_radius(radius);
  return request;
}

/// By how much the nearest two overlap, their periodic images among them, in diameters: 0 where none do.
double overlap_of(const Grains& particles)
{
  const granular::Box& box = particles.frame.header.box;
  Quad worst = 0;
  for (int n = 0; n < 27; ++n)
  {
    const std::array<int, 3> image = { n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 };
    bool there = true;
    std::array<Quad, 3> shift = {};
    for (std::size_t k = 0; k < 3; ++k)
    {
      there = there && (image[k] == 0 || box.boundary[3 * k] == 'p');
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const granular::Twofold edge = box.vectors[k][axis];
        shift[axis] += image[k] * (static_cast<Quad>(edge.hi) + edge.lo);
      }
    }
    for (std::size_t i = 0; there && i < particles.size(); ++i)
    {
      for (std::size_t j = 0; j <= i; ++j)
      {
        const double sum = particles.radius[i] + particles.radius[j];
        double rough = 0;
        Quad square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const Quad away =
            static_cast<Quad>(particles.points[i][axis]) - particles.points[j][axis] + shift[axis];
          rough += static_cast<double>(away) * static_cast<double>(away);
          square += away * away;
        }
        if ((i != j || n != 13) && rough < 1.1 * sum * sum)
        {
          const Quad least = static_cast<Quad>(particles.radius[i]) + particles.radius[j];
          worst = std::max(worst, (least * least - square) / (2 * least * least));
        }
      }
    }
  }
  return static_cast<double>(worst);
}
}

TEST(PackingLattice, SimpleCubicFillsABoxFromWallToWall)
{
  const Grains particles(
    on(Arrangement::SimpleCubic, tilted_box({ 1, 2, 3 }, { 4, 5, 6 }), "f f f"));
  ASSERT_EQ(particles.size(), 4u * 5 * 6);
  EXPECT_NEAR(particles.least_gap(), 0, 1e-12);
  EXPECT_NEAR(particles.least_inside(), 0, 1e-12);
  std::set<std::array<long, 3>> places;
  for (const Vector3& point : particles.points)
  {
    std::array<long, 3> place = {};
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double from_corner = point[k] - static_cast<double>(k + 1) - 0.5;
      EXPECT_NEAR(from_corner, std::round(from_corner), 1e-12);
      place[k] = std::lround(from_corner);
    }
    places.insert(place);
  }
  EXPECT_EQ(places.size(), particles.size());
  EXPECT_EQ(*places.begin(), (std::array<long, 3>{ 0, 0, 0 }));
  EXPECT_EQ(*places.rbegin(), (std::array<long, 3>{ 3, 4, 5 }));
  EXPECT_EQ(particles.frame.header.box.boundary, "ff ff ff");
}

// Cells are sqrt(2) wide, with four particles each.
TEST(PackingLattice, FaceCentredCubicIsAClosestPacking)
{
  const double cell = std::sqrt(2.0);
  const Grains particles(
    on(Arrangement::FaceCentredCubic, tilted_box({}, { 3 * cell, 4 * cell, 5 * cell }), "p p p"));
  ASSERT_EQ(particles.size(), 240u);
  EXPECT_NEAR(particles.solid_fraction(), std::acos(-1.0) / std::sqrt(18.0), 1e-12);
  EXPECT_NEAR(particles.least_gap(), 0, 1e-12);
}

TEST(PackingLattice, PeriodicCellsAreStretchedToTheBox)
{
  const Grains particles(on(Arrangement::SimpleCubic, tilted_box({}, { 4.9, 5, 6.1 }), "p p f"));
  ASSERT_EQ(particles.size(), 4u * 5 * 6);
  EXPECT_NEAR(particles.points[1][0] - particles.points[0][0], 4.9 / 4, 1e-12);
  EXPECT_NEAR(particles.points[20][2] - particles.points[0][2], 1, 1e-12); // across z as asked for
  EXPECT_NEAR(particles.points[0][2], 0.55, 1e-12);                        // and in the middle
  EXPECT_NEAR(particles.least_gap(), 0, 1e-12);
}

TEST(PackingLattice, SpacingIsTheDistanceOfNeighboursInAnyBox)
{
  const Vector3 tilts[] = { { 0, 0, 0 }, { 2, 0, 0 }, { 4, 4, 4 }, { -11, 7, 13 } };
  for (const Vector3& tilt : tilts)
  {
    for (const Arrangement arrangement : arrangements)
    {
      for (const char* const boundary : { "p p p", "f f f", "p f p", "m s p" })
      {
        PackingRequest request =
          on(arrangement, tilted_box({ -3, 0, 9 }, { 19, 11, 8 }, tilt), boundary);
        request.spacing = 1.01;
        const Grains particles(request);
        EXPECT_GT(particles.size(), 6u);
        EXPECT_GT(particles.least_gap(), arrangement == Arrangement::Chain ? -1e-11 : 0.01 - 1e-11)
          << boundary << " " << tilt[0];
        EXPECT_GT(particles.least_inside(), -1e-12) << boundary << " " << tilt[0];
      }
    }
  }
}

TEST(PackingLattice, NoneOverlapToTheLastBit)
{
  HardCase hard("packings",
    "lattices and chains in boxes that hold them exactly or with room, straight or tilted, up to "
    "2e6 away, in 113 bits: overlap of the nearest two",
    "diameters", 0);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  for (std::size_t i = 0; i < 120; ++i)
  {
    const double radius = i % 5 < 2 ? 0.5 : i % 5 < 4 ? 0.1 : 0.05 + part(random);
    const double far = i % 7 < 4 ? 0 : std::array{ 0.1, 1e3, 1e6 }[i % 7 - 4];
    Vector3 lengths;
    for (double& length : lengths)
    {
      // whole numbers of diameters, but for the last bits, or any length
      const double diameters = 4 + std::floor(2 * part(random));
      length = 2 * radius * (i % 2 == 0 ? diameters : diameters + part(random));
    }
    const Vector3 tilts = { radius * part(random), -radius * part(random), 0.5 * radius };
    const Grains particles(on(arrangements[i % 3],
      tilted_box({ far, -far, 2 * far }, lengths, i % 4 == 3 ? tilts : Vector3{}),
      std::array{ "f f f", "p p p", "p f p", "f p f" }[i / 3 % 4], radius));
    hard.add(overlap_of(particles), static_cast<std::int64_t>(particles.size()));
    for (const double made : particles.radius)
    {
      EXPECT_LE(made, radius);
      EXPECT_GT(made, radius * (1 - 1e-13) - 1e-14 * far);
    }
    EXPECT_GT(particles.least_inside(), -1e-12 * (1 + far));
  }
  for (int i = 0; i < 60; ++i)
  {
    const double turn = 0.37 * i;
    const double far = i % 3 == 2 ? 1e6 : 0;
    const Grains particles(on(arrangements[i % 2],
      tilted_box({ far, -far, 2 * far }, { 6.2 + std::sin(turn), 7.3 - std::cos(3 * turn), 6.5 },
        { 2 * std::sin(2 * turn), 1.7 * std::cos(turn), -1.1 * std::sin(5 * turn) }),
      i % 4 < 2 ? "p p f" : "f f f"));
    EXPECT_GT(particles.size(), 60u);
    hard.add(overlap_of(particles), static_cast<std::int64_t>(particles.size()));
  }
}

/// A box with room along x and z, and none along y. 128 pairs once overlapped by 1e-16.
TEST(PackingLattice, ABoxThatIsTightAlongOneAxis)
{
  const Grains particles(on(Arrangement::SimpleCubic,
    tilted_box({}, { 6.785606236300253, 10, 8.283244719637754 }), "f f f"));
  EXPECT_EQ(particles.size(), 6u * 10 * 8);
  EXPECT_EQ(overlap_of(particles), 0);
  EXPECT_EQ(particles.radius[0], 0.5);
  EXPECT_EQ(particles.points[0][1], 0.5);
}

/// Two cells, next to no room to stretch them; and a pair along a 3-4-5 triangle across two periodic axes, which is 1 apart
/// until a cell fewer fits.
TEST(PackingLattice, TiltedBoxesHoldWhatFits)
{
  const Grains small(
    on(Arrangement::FaceCentredCubic, tilted_box({}, { 5, 2, 2.5 }, { 1.3, 0.5, -0.4 }), "f f f"));
  EXPECT_EQ(small.size(), 8u);
  EXPECT_EQ(overlap_of(small), 0);
  const Grains exact(
    on(Arrangement::FaceCentredCubic, tilted_box({}, { 10, 8, 6 }, { 4, 3.1, -2.4 }), "p p f"));
  EXPECT_GT(exact.size(), 200u);
  EXPECT_EQ(overlap_of(exact), 0);
}

/// Straight boxes hold as many as arithmetic says, also where the last bits of the length are missing.
TEST(PackingLattice, AsManyAsFit)
{
  PackingRequest request =
    on(Arrangement::SimpleCubic, tilted_box({ 0.3, 0, 0 }, { 1, 0.6, 0.8 }), "f p f", 0.1);
  EXPECT_EQ(Grains(request).size(), 5u * 3 * 4);
  request.arrangement = Arrangement::Chain;
  EXPECT_EQ(Grains(request).size(), 5u);
}

/// Boxes that are made leave the room that rounding takes: radii are those asked for.
TEST(PackingLattice, ABoxIsMadeForANumber)
{
  for (const Arrangement arrangement : arrangements)
  {
    for (const std::int64_t number : { 2, 7, 60 })
    {
      for (const char* const boundary : { "p p p", "f f f", "p f p" })
      {
        PackingRequest request;
        request.arrangement = arrangement;
        request.particles = number;
        request.radii = one_radius(0.3);
        request.boundary = boundary;
        request.corner = { 0.1, -3, 1e3 };
        const Grains particles(request);
        ASSERT_EQ(particles.size(), static_cast<std::size_t>(number));
        EXPECT_EQ(particles.frame.header.rows, number);
        EXPECT_EQ(overlap_of(particles), 0);
        EXPECT_GT(particles.least_inside(), -1e-12);
        EXPECT_EQ(*std::ranges::min_element(particles.radius), 0.3);
        const auto [least, most] = std::ranges::minmax(particles.heights);
        EXPECT_TRUE(arrangement == Arrangement::Chain || most / least < 3);
      }
    }
  }
}

TEST(PackingLattice, TheLargestOfSeveralRadiiSetsTheDistance)
{
  PackingRequest request;
  request.arrangement = Arrangement::FaceCentredCubic;
  request.particles = 500;
  request.radii = two_radii(0.2, 0.5, 0.25);
  const Grains two(request);
  EXPECT_EQ(std::count(two.radius.begin(), two.radius.end(), 0.5), 125);
  for (std::size_t i = 0; i < two.size(); ++i)
  {
    EXPECT_EQ(two.type[i], two.radius[i] == 0.5 ? 2 : 1);
  }
  EXPECT_NEAR(two.least_gap(), 0, 1e-12);
}

TEST(PackingLattice, FewerThanTheBoxHoldsFillItFromBelow)
{
  PackingRequest request = on(Arrangement::SimpleCubic, tilted_box({}, { 4, 4, 4 }), "f f f");
  request.particles = 18;
  const Grains particles(request);
  ASSERT_EQ(particles.size(), 18u);
  EXPECT_EQ(particles.points[15][2], 0.5);
  EXPECT_EQ(particles.points[17], (Vector3{ 1.5, 0.5, 1.5 }));
}

TEST(PackingLattice, AChainBeginsARadiusInsideAndIsInTheMiddle)
{
  PackingRequest request = on(Arrangement::Chain, tilted_box({ 1, 2, 3 }, { 12, 4, 6 }), "f f f");
  request.particles = 7;
  request.spacing = 1.25;
  const Grains particles(request);
  ASSERT_EQ(particles.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i)
  {
    EXPECT_NEAR(particles.points[i][0], 1.5 + 1.25 * static_cast<double>(i), 1e-13);
    EXPECT_NEAR(particles.points[i][1], 4, 1e-13);
    EXPECT_NEAR(particles.points[i][2], 6, 1e-13);
  }
  EXPECT_EQ(particles.frame.schema.text(), "id type mol x y z radius vx vy vz");
}

TEST(PackingLattice, AChainHasAsManyAsTheBoxHolds)
{
  PackingRequest request = on(Arrangement::Chain, tilted_box({}, { 12, 4, 6 }), "f f f");
  EXPECT_EQ(Grains(request).size(), 12u);
  request.boundary = "p p p";
  EXPECT_EQ(Grains(request).size(), 12u);
  request.spacing = 1.1; // 11 / 1.1 gaps
  EXPECT_EQ(Grains(request).size(), 11u);
}
