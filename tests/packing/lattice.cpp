// SPDX-License-Identifier: BSD-3-Clause
// Grains on lattices: counts and places from arithmetic, distances from a look at all pairs.
#include "../support/hard_case.h"
#include "../support/packings.h"

#include "../support/quad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace
{
using granular::Arrangement;
using granular::PackingRequest;
using granular::Vector3;

constexpr Arrangement lattices[] = { Arrangement::SimpleCubic, Arrangement::FaceCentredCubic,
  Arrangement::Hexagonal };

PackingRequest on(Arrangement arrangement, const granular::Box& box, const std::string& boundary)
{
  PackingRequest request;
  request.arrangement = arrangement;
  request.box = box;
  request.boundary = boundary;
  request.radii = one_radius(0.5);
  return request;
}

/// Grains that touch any other, by how many they touch.
std::multiset<int> contacts(const Grains& grains)
{
  std::multiset<int> counts;
  for (std::size_t i = 0; i < grains.size(); ++i)
  {
    int count = 0;
    for (std::size_t j = 0; j < grains.size(); ++j)
    {
      double square = 0;
      for (std::size_t k = 0; k < 3; ++k)
      {
        // orthogonal boxes: the nearest image
        const double length = grains.vectors[k][k];
        const double away = grains.points[i][k] - grains.points[j][k];
        square += std::pow(away - length * std::round(away / length), 2);
      }
      count += i != j && std::abs(std::sqrt(square) - 1) < 1e-9 ? 1 : 0;
    }
    counts.insert(count);
  }
  return counts;
}
}

namespace
{
/// The square of the distance of a grain and an image of another one.
template <class Float>
Float square_of(const Grains& grains, std::size_t i, std::size_t j, const std::array<int, 3>& image)
{
  Float square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    Float away = static_cast<Float>(grains.points[i][axis]) - grains.points[j][axis];
    for (std::size_t k = 0; k < 3; ++k)
    {
      away += image[k] * static_cast<Float>(grains.vectors[k][axis]);
    }
    square += away * away;
  }
  return square;
}

/// How much farther apart the nearest two grains of radius 0.5 or images are than 1, by arithmetic of 113 bits.
double least_excess(const Grains& grains)
{
  Quad least = 2;
  for (int n = 0; n < 27; ++n)
  {
    const std::array<int, 3> image = { n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 };
    bool there = true;
    for (std::size_t k = 0; k < 3; ++k)
    {
      there = there && (image[k] == 0 || grains.frame.header.box.boundary[3 * k] == 'p');
    }
    for (std::size_t i = 0; there && i < grains.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        if (square_of<double>(grains, i, j, image) < 1.1)
        {
          least = std::min(least, square_of<Quad>(grains, i, j, image));
        }
      }
    }
  }
  return static_cast<double>((least - 1) / 2);
}
}

TEST(PackingLattice, SimpleCubicFillsABoxFromWallToWall)
{
  const Grains grains(on(Arrangement::SimpleCubic, tilted_box({ 1, 2, 3 }, { 4, 5, 6 }), "f f f"));
  ASSERT_EQ(grains.size(), 4u * 5 * 6);
  EXPECT_NEAR(grains.least_gap(), 0, 1e-12);
  EXPECT_NEAR(grains.least_inside(), 0, 1e-12);
  std::set<std::array<long, 3>> places;
  for (const Vector3& point : grains.points)
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
  EXPECT_EQ(places.size(), grains.size());
  EXPECT_EQ(*places.begin(), (std::array<long, 3>{ 0, 0, 0 }));
  EXPECT_EQ(*places.rbegin(), (std::array<long, 3>{ 3, 4, 5 }));
  EXPECT_EQ(grains.frame.header.box.boundary, "ff ff ff");
}

// cells of FCC are sqrt(2) wide, of HCP 1 x sqrt(3) x sqrt(8/3); four grains each
TEST(PackingLattice, ClosestPackingsHaveTwelveNeighboursAndTheirDensity)
{
  const double fcc = std::sqrt(2.0);
  const struct
  {
    Arrangement arrangement;
    Vector3 lengths;
    std::size_t grains;
  } cases[] = { { Arrangement::FaceCentredCubic, { 3 * fcc, 4 * fcc, 5 * fcc }, 240 },
    { Arrangement::Hexagonal, { 4, 3 * std::sqrt(3.0), 3 * std::sqrt(8.0 / 3) }, 144 } };
  for (const auto& each : cases)
  {
    const Grains grains(on(each.arrangement, tilted_box({}, each.lengths), "p p p"));
    ASSERT_EQ(grains.size(), each.grains);
    EXPECT_NEAR(grains.solid_fraction(), std::acos(-1.0) / std::sqrt(18.0), 1e-12);
    EXPECT_NEAR(grains.least_gap(), 0, 1e-12);
    const std::multiset<int> neighbours = contacts(grains);
    EXPECT_EQ(neighbours.count(12), grains.size());
  }
}

TEST(PackingLattice, PeriodicCellsAreStretchedToTheBox)
{
  const Grains grains(on(Arrangement::SimpleCubic, tilted_box({}, { 4.9, 5, 6.1 }), "p p f"));
  ASSERT_EQ(grains.size(), 4u * 5 * 6);
  EXPECT_NEAR(grains.points[1][0] - grains.points[0][0], 4.9 / 4, 1e-12);
  EXPECT_NEAR(grains.points[20][2] - grains.points[0][2], 1, 1e-12); // across z as asked for
  EXPECT_NEAR(grains.points[0][2], 0.55, 1e-12);                     // and in the middle
  EXPECT_NEAR(grains.least_gap(), 0, 1e-12);
}

TEST(PackingLattice, SpacingIsTheDistanceOfNeighbours)
{
  for (const Arrangement arrangement : lattices)
  {
    PackingRequest request = on(arrangement, tilted_box({}, { 9, 9, 9 }), "f f f");
    request.spacing = 1.25;
    EXPECT_NEAR(Grains(request).least_gap(), 0.25, 1e-12);
  }
}

TEST(PackingLattice, NoneOverlapInTiltedBoxes)
{
  const Vector3 tilts[] = { { 2, 0, 0 }, { 0, -3, 1 }, { 4, 4, 4 }, { -11, 7, 13 } };
  for (const Vector3& tilt : tilts)
  {
    for (const Arrangement arrangement : lattices)
    {
      for (const char* const boundary : { "p p p", "f f f", "p f p", "m s p" })
      {
        PackingRequest request =
          on(arrangement, tilted_box({ -3, 0, 9 }, { 9, 11, 8 }, tilt), boundary);
        request.spacing = 1.01;
        const Grains grains(request);
        EXPECT_GT(grains.size(), 30u);
        EXPECT_GT(grains.least_gap(), 0.01 - 1e-11) << boundary << " " << tilt[0];
        EXPECT_GT(grains.least_inside(), -1e-12) << boundary << " " << tilt[0];
      }
    }
  }
}

// Hexagonal cells in the first of these boxes were once 4e-12 of a diameter too near.
TEST(PackingLattice, NoneOverlapInTiltedBoxesToTheLastBit)
{
  std::vector<PackingRequest> requests = {
    on(Arrangement::Hexagonal, tilted_box({}, { 10, 10, 10 }, { -0.1, 1.2, -1 }), "p p f"),
  };
  for (int i = 0; i < 60; ++i)
  {
    const double turn = 0.37 * i;
    const double far = i % 3 == 2 ? 1e6 : 0;
    requests.push_back(on(lattices[i % 3],
      tilted_box({ far, -far, 2 * far }, { 6.2 + std::sin(turn), 7.3 - std::cos(3 * turn), 6.5 },
        { 2 * std::sin(2 * turn), 1.7 * std::cos(turn), -1.1 * std::sin(5 * turn) }),
      i % 2 == 0 ? "p p f" : "f f f"));
  }
  HardCase hard("packings",
    "lattices in tilted boxes, up to 2e6 away, in 113 bits: overlap of the nearest two",
    "diameters", 0);
  for (const PackingRequest& request : requests)
  {
    const Grains grains(request);
    EXPECT_GT(grains.size(), 60u);
    const double excess = least_excess(grains);
    hard.add(std::max(0.0, -excess), static_cast<std::int64_t>(grains.size()));
    EXPECT_GE(excess, 0) << grains.vectors[2][0];
  }
}

/// Boxes that the old way filled as well, found by hand: two cells, next to no room to stretch them.
TEST(PackingLattice, SmallTiltedBoxesHoldWhatFits)
{
  const PackingRequest requests[] = {
    on(Arrangement::FaceCentredCubic, tilted_box({}, { 5, 2, 2.5 }, { 1.3, 0.5, -0.4 }), "f f f"),
    on(Arrangement::Hexagonal, tilted_box({}, { 4, 3.5, 2 }, { -0.6, -1.2, 0.1 }), "f f f"),
    on(Arrangement::Hexagonal, tilted_box({}, { 5, 2.5, 3.5 }, { 1.5, 2.3, -1.1 }), "p p f"),
  };
  for (const PackingRequest& request : requests)
  {
    const Grains grains(request);
    EXPECT_EQ(grains.size(), 8u);
    EXPECT_GE(least_excess(grains), 0);
  }
}

/// A pair along a 3-4-5 triangle across two periodic axes is 1 apart until a cell fewer fits.
TEST(PackingLattice, ADistanceThatRoundingAloneMakesTooShortEnds)
{
  const Grains grains(
    on(Arrangement::FaceCentredCubic, tilted_box({}, { 10, 8, 6 }, { 4, 3.1, -2.4 }), "p p f"));
  EXPECT_GT(grains.size(), 200u);
  EXPECT_GE(least_excess(grains), 0);
}

TEST(PackingLattice, ABoxIsMadeForANumber)
{
  for (const Arrangement arrangement : lattices)
  {
    for (const std::int64_t number : { 1, 2, 7, 100, 1000, 1001 })
    {
      for (const char* const boundary : { "p p p", "f f f", "p f p" })
      {
        PackingRequest request;
        request.arrangement = arrangement;
        request.grains = number;
        request.radii = one_radius(0.3);
        request.boundary = boundary;
        const Grains grains(request);
        ASSERT_EQ(grains.size(), static_cast<std::size_t>(number));
        EXPECT_EQ(grains.frame.header.rows, number);
        EXPECT_GT(grains.least_gap(), -1e-12);
        EXPECT_GT(grains.least_inside(), -1e-12);
        const auto [least, most] =
          std::minmax_element(grains.heights.begin(), grains.heights.end());
        EXPECT_LT(*most / *least, 3);
      }
    }
  }
}

TEST(PackingLattice, TheLargestOfSeveralRadiiSetsTheDistance)
{
  PackingRequest request;
  request.arrangement = Arrangement::FaceCentredCubic;
  request.grains = 500;
  request.radii = two_radii(0.2, 0.5, 0.25);
  const Grains two(request);
  EXPECT_EQ(std::count(two.radius.begin(), two.radius.end(), 0.5), 125);
  for (std::size_t i = 0; i < two.size(); ++i)
  {
    EXPECT_EQ(two.type[i], two.radius[i] == 0.5 ? 2 : 1);
  }
  EXPECT_NEAR(two.least_gap(), 0, 1e-12);
  request.radii = radii_between(0.5, 0.1);
  const Grains range(request);
  const auto [least, most] = std::minmax_element(range.radius.begin(), range.radius.end());
  EXPECT_NEAR(*least, 0.1 + 0.4 / 1000, 1e-12); // the middles of 500 equal parts
  EXPECT_NEAR(*most, 0.5 - 0.4 / 1000, 1e-12);
  EXPECT_GT(range.least_gap(), -1e-12);
}

TEST(PackingLattice, FewerThanTheBoxHoldsFillItFromBelow)
{
  PackingRequest request = on(Arrangement::SimpleCubic, tilted_box({}, { 4, 4, 4 }), "f f f");
  request.grains = 18;
  const Grains grains(request);
  ASSERT_EQ(grains.size(), 18u);
  EXPECT_EQ(grains.points[15][2], 0.5);
  EXPECT_EQ(grains.points[17], (Vector3{ 1.5, 0.5, 1.5 }));
}
