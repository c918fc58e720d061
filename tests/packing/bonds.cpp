// SPDX-License-Identifier: BSD-3-Clause
// Bonds of particles: numbers from arithmetic, and each bond against all pairs and their images.
#include "../support/error_of.h"
#include "../support/packings.h"

#include "granular/common/error.h"
#include "granular/packing/packing_plan.h"

#include "../support/quad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace
{
using granular::Arrangement;
using granular::PackingRequest;
using granular::Vector3;

using Pair = std::pair<std::int64_t, std::int64_t>;

template <typename T>
std::vector<T> values(const granular::Block& block, std::int64_t count)
{
  const auto* const from = static_cast<const T*>(block.data());
  return std::vector<T>(from, from + count);
}

struct Bonds
{
  Bonds(const PackingRequest& request, double factor)
    : particles(request)
  {
    granular::Progress progress;
    const granular::PackingPlan plan(request, progress);
    const granular::GrainBonds made = granular::make_bonds(plan, factor, progress);
    id1 = values<std::int64_t>(made.id1, made.count);
    id2 = values<std::int64_t>(made.id2, made.count);
    btype = values<std::int32_t>(made.btype, made.count);
    length = values<double>(made.equilibrium_length, made.count);
    ends = values<std::array<Vector3, 2>>(made.points, made.count);
  }

  std::size_t size() const { return id1.size(); }

  void append(const Bonds& more)
  {
    id1.insert(id1.end(), more.id1.begin(), more.id1.end());
    id2.insert(id2.end(), more.id2.begin(), more.id2.end());
    btype.insert(btype.end(), more.btype.begin(), more.btype.end());
    length.insert(length.end(), more.length.begin(), more.length.end());
    ends.insert(ends.end(), more.ends.begin(), more.ends.end());
  }

  bool operator==(const Bonds& other) const
  {
    return id1 == other.id1 && id2 == other.id2 && btype == other.btype && length == other.length &&
      ends == other.ends;
  }

  Grains particles;
  std::vector<std::int64_t> id1;
  std::vector<std::int64_t> id2;
  std::vector<std::int32_t> btype;
  std::vector<double> length;
  std::vector<std::array<Vector3, 2>> ends;
};

/// How many images of the box along each vector a reach needs: sufficient in any box.
std::array<int, 3> images_for(const Grains& particles, double reach)
{
  std::array<int, 3> most = {};
  for (std::size_t k = 0; k < 3; ++k)
  {
    const bool periodic = particles.frame.header.box.boundary[3 * k] == 'p';
    most[k] = periodic ? static_cast<int>(std::ceil(reach / particles.heights[k])) + 1 : 0;
  }
  return most;
}

/// By Newton's method from the double nearest to it.
Quad sqrt_of(Quad square)
{
  const Quad root = std::sqrt(static_cast<double>(square));
  return (root + square / root) / 2;
}

/// The square of the distance of the nearest images of two particles.
template <class Float>
Float nearest(const Grains& particles, std::size_t i, std::size_t j, const std::array<int, 3>& most)
{
  Float least = std::numeric_limits<double>::max();
  for (int z = -most[2]; z <= most[2]; ++z)
  {
    for (int y = -most[1]; y <= most[1]; ++y)
    {
      for (int x = -most[0]; x <= most[0]; ++x)
      {
        Float square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const Float edge = static_cast<Float>(particles.points[j][axis]) -
            particles.points[i][axis] + x * static_cast<Float>(particles.vectors[0][axis]) +
            y * static_cast<Float>(particles.vectors[1][axis]) +
            z * static_cast<Float>(particles.vectors[2][axis]);
          square += edge * edge;
        }
        least = std::min(least, square);
      }
    }
  }
  return least;
}

/// All pairs that are near enough, with their distances. Those of which rounding decides would be no test.
std::map<Pair, long double> all_pairs(const Grains& particles, double factor)
{
  const double largest = *std::max_element(particles.radius.begin(), particles.radius.end());
  const std::array<int, 3> most = images_for(particles, 2 * factor * largest);
  std::map<Pair, long double> found;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    for (std::size_t j = i + 1; j < particles.size(); ++j)
    {
      const long double limit =
        factor * (static_cast<long double>(particles.radius[i]) + particles.radius[j]);
      const long double distance = std::sqrt(nearest<long double>(particles, i, j, most));
      EXPECT_GT(std::abs(distance / limit - 1), 1e-8L);
      if (distance <= limit)
      {
        found[{ particles.id[i], particles.id[j] }] = distance;
      }
    }
  }
  return found;
}

/// How far a point is from the nearest image of a particle, in box vectors.
double away_from_images(Grains& particles, const Vector3& point, std::int64_t id)
{
  particles.points.push_back(point);
  const Vector3 there = particles.scaled(particles.points.size() - 1);
  particles.points.pop_back();
  const Vector3 at = particles.scaled(static_cast<std::size_t>(id - 1));
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double steps = there[k] - at[k];
    const bool periodic = particles.frame.header.box.boundary[3 * k] == 'p';
    most = std::max(most, std::abs(periodic ? steps - std::round(steps) : steps));
  }
  return most;
}

/// What coordinates lose by rounding.
double tolerance(const Grains& particles)
{
  const Vector3& point = particles.points[0];
  return 1e-13 + 1e-15 * (std::abs(point[0]) + std::abs(point[1]) + std::abs(point[2]));
}

/// Each bond is what it says, and they are in order.
void expect_sound(Bonds& bonds)
{
  const double rounding = tolerance(bonds.particles);
  for (std::size_t i = 0; i < bonds.size(); ++i)
  {
    const auto& [first, second] = bonds.ends[i];
    EXPECT_EQ(first, bonds.particles.points[static_cast<std::size_t>(bonds.id1[i] - 1)]);
    EXPECT_LT(away_from_images(bonds.particles, second, bonds.id2[i]), 10 * rounding);
    EXPECT_NEAR(std::hypot(second[0] - first[0], second[1] - first[1], second[2] - first[2]),
      bonds.length[i], rounding);
    EXPECT_EQ(bonds.btype[i], 1);
    EXPECT_LT(bonds.id1[i], bonds.id2[i]);
    if (i > 0)
    {
      EXPECT_LT(Pair(bonds.id1[i - 1], bonds.id2[i - 1]), Pair(bonds.id1[i], bonds.id2[i]));
    }
  }
}

void expect_all_pairs(const PackingRequest& request, double factor)
{
  Bonds bonds(request, factor);
  expect_sound(bonds);
  const std::map<Pair, long double> pairs = all_pairs(bonds.particles, factor);
  ASSERT_EQ(bonds.size(), pairs.size());
  const double rounding = tolerance(bonds.particles);
  std::size_t i = 0;
  for (const auto& [pair, distance] : pairs)
  {
    EXPECT_EQ(pair, Pair(bonds.id1[i], bonds.id2[i]));
    EXPECT_NEAR(static_cast<double>(distance), bonds.length[i], rounding);
    ++i;
  }
}

PackingRequest request_for(Arrangement arrangement, const Vector3& lengths,
  const std::string& boundary, const Vector3& tilts = {})
{
  PackingRequest request;
  request.arrangement = arrangement;
  request.box = tilted_box({}, lengths, tilts);
  request.boundary = boundary;
  request.radii = one_radius(0.5);
  return request;
}

std::size_t count_of(
  Arrangement arrangement, const Vector3& lengths, const std::string& boundary, double factor)
{
  Bonds bonds(request_for(arrangement, lengths, boundary), factor);
  expect_sound(bonds);
  return bonds.size();
}

struct Case
{
  const char* name;
  double factor;
  std::function<void(PackingRequest&)> choose;
};

const Case cases[] = {
  { "random, walls", 1.3, [](PackingRequest&) {} },
  { "random, periodic", 1.3, [](PackingRequest& r) { r.boundary = "p p p"; } },
  { "random, two sizes, tilted, far away", 1.5,
    [](PackingRequest& r)
    {
      r.box = tilted_box({ 1e5, -1e5, 3e4 }, { 9, 8, 10 }, { 3, -4, 5 });
      r.boundary = "p f p";
      r.radii = two_radii(0.2, 0.6, 0.3);
    } },
  { "random, 20 to 1, strongly tilted", 2.2,
    [](PackingRequest& r)
    {
      r.box = tilted_box({ -1, 0, 2 }, { 12, 16, 14 }, { 8, -9, 11 });
      r.boundary = "p p p";
      r.radii = two_radii(0.05, 1, 0.02);
    } },
  { "simple cubic with gaps", 1.5,
    [](PackingRequest& r)
    {
      r.arrangement = Arrangement::SimpleCubic;
      r.spacing = 1.04;
      r.boundary = "p p f";
    } },
  { "face-centred cubic, tilted, two sizes", 1.9,
    [](PackingRequest& r)
    {
      r.arrangement = Arrangement::FaceCentredCubic;
      r.particles = 0;
      r.box = tilted_box({ 1, 2, 3 }, { 8, 9, 7 }, { -2, 5, 3 });
      r.boundary = "p p p";
      r.radii = two_radii(0.3, 0.5, 0.5);
    } },
  { "face-centred cubic, not full", 2.9,
    [](PackingRequest& r)
    {
      r.arrangement = Arrangement::FaceCentredCubic;
      r.boundary = "p p p";
      r.particles = 301;
    } },
  { "two cells", 1.5,
    [](PackingRequest& r)
    {
      r.arrangement = Arrangement::SimpleCubic;
      r.particles = 0;
      r.box = tilted_box({}, { 2.2, 2.3, 2.5 }, { 0.3, 0.1, -0.2 });
      r.boundary = "p p p";
    } },
  { "thin and sheared: the nearest image is several boxes away", 2.9,
    [](PackingRequest& r)
    {
      r.particles = 0;
      r.box = tilted_box({}, { 20, 20, 1.1 }, { 0, 7.6, 4.4 });
      r.boundary = "p p p";
    } },
  { "few, as near as can be, and three times that", 2.99,
    [](PackingRequest& r)
    {
      r.particles = 3;
      r.box = tilted_box({}, { 2, 2, 2 }, { 0.9, 0.7, -0.8 });
      r.boundary = "p p p";
    } },
};

PackingRequest request_of(const Case& each)
{
  PackingRequest request;
  request.particles = 400;
  request.radii = one_radius(0.5);
  each.choose(request);
  return request;
}

std::string bonds_error(const PackingRequest& request, double factor)
{
  return ::error_of<granular::LimitError>([&] { Bonds(request, factor); });
}
}

TEST(PackingBonds, SimpleCubicHasThreeForEachParticleButForWalls)
{
  for (const std::size_t n : { 3u, 4u, 7u })
  {
    const auto edge = static_cast<double>(n);
    for (const double factor : { 1.0, 1.05, 1.4 })
    {
      EXPECT_EQ(count_of(Arrangement::SimpleCubic, { edge, edge, edge }, "f f f", factor),
        3 * n * n * (n - 1));
      EXPECT_EQ(
        count_of(Arrangement::SimpleCubic, { edge, edge, edge }, "p p p", factor), 3 * n * n * n);
      EXPECT_EQ(count_of(Arrangement::SimpleCubic, { edge, edge, edge }, "f p f", factor),
        n * n * n + 2 * n * n * (n - 1));
    }
  }
  // of the next nearest, at sqrt(2): six more for each particle
  EXPECT_EQ(count_of(Arrangement::SimpleCubic, { 5, 5, 5 }, "p p p", 1.42), 9u * 125);
}

TEST(PackingBonds, APairHasOneAndAParticleNoneWithItself)
{
  EXPECT_EQ(count_of(Arrangement::SimpleCubic, { 2, 2, 2 }, "p p p", 1.1), 12u);
  EXPECT_EQ(count_of(Arrangement::SimpleCubic, { 2, 2, 2 }, "p p p", 3), 28u);
  EXPECT_EQ(count_of(Arrangement::SimpleCubic, { 1, 1, 2 }, "p p p", 3), 1u);
  EXPECT_EQ(count_of(Arrangement::SimpleCubic, { 1, 1, 1 }, "p p p", 3), 0u);
  EXPECT_EQ(count_of(Arrangement::SimpleCubic, { 1, 1, 1 }, "f f f", 3), 0u);
  // of two ways that are equally long that which stays in the box
  const Bonds two(request_for(Arrangement::SimpleCubic, { 1, 1, 2 }, "p p p"), 1.1);
  EXPECT_EQ(two.ends[0][1], two.particles.points[1]);
}

TEST(PackingBonds, FaceCentredCubicHasSixForEachParticle)
{
  const double cell = std::sqrt(2.0);
  for (const double factor : { 1.0, 1.05, 1.4 })
  {
    EXPECT_EQ(
      count_of(Arrangement::FaceCentredCubic, { 3 * cell, 4 * cell, 5 * cell }, "p p p", factor),
      6u * 240);
  }
}

TEST(PackingBonds, AreThoseOfAllPairs)
{
  for (const Case& each : cases)
  {
    SCOPED_TRACE(each.name);
    expect_all_pairs(request_of(each), each.factor);
  }
}

// The reference is the shortest image by arithmetic of 113 bits: the images of particles far from the origin have 1e-10
// of a box of 1, the vector between two particles all its digits.
TEST(PackingBonds, LengthsAcrossPeriodicFacesAreExact)
{
  for (const double far : { 0.0, 1e6, -3e5 })
  {
    for (const Vector3& tilts : { Vector3{}, Vector3{ 0.3, -0.7, 1.3 } })
    {
      PackingRequest request;
      request.particles = 300;
      request.box = tilted_box({ far, -far, far / 3 }, { 3.1, 3.7, 2.9 }, tilts);
      request.boundary = "p p p";
      request.radii = one_radius(0.17);
      const Bonds bonds(request, 1.4);
      std::size_t across = 0;
      for (std::size_t i = 0; i < bonds.size(); ++i)
      {
        const auto first = static_cast<std::size_t>(bonds.id1[i] - 1);
        const auto second = static_cast<std::size_t>(bonds.id2[i] - 1);
        const auto exact =
          static_cast<double>(sqrt_of(nearest<Quad>(bonds.particles, first, second, { 2, 2, 2 })));
        EXPECT_LE(std::abs(bonds.length[i] - exact), 1.5e-15 * exact) << far;
        across += bonds.ends[i][1] == bonds.particles.points[second] ? 0u : 1u;
      }
      EXPECT_GT(across, 30u);
    }
  }
}

TEST(PackingBonds, OfAChainJoinConsecutiveParticles)
{
  PackingRequest request;
  request.arrangement = Arrangement::Chain;
  request.particles = 9;
  request.spacing = 1.25;
  request.radii = one_radius(0.5);
  Bonds bonds(request, 1); // longer than the factor says
  expect_sound(bonds);
  ASSERT_EQ(bonds.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i)
  {
    EXPECT_EQ(bonds.id1[i], static_cast<std::int64_t>(i + 1));
    EXPECT_EQ(bonds.id2[i], static_cast<std::int64_t>(i + 2));
    EXPECT_NEAR(bonds.length[i], 1.25, 1e-14);
  }
  request.particles = 1;
  EXPECT_EQ(Bonds(request, 1).size(), 0u);
}

TEST(PackingBonds, OfPiecesAndThreadsAreTheWhole)
{
  std::vector<PackingRequest> requests;
  for (const Case& each : cases)
  {
    requests.push_back(request_of(each));
  }
  PackingRequest many; // several chunks
  many.particles = 20000;
  for (const Arrangement arrangement :
    { Arrangement::Random, Arrangement::SimpleCubic, Arrangement::Chain })
  {
    many.arrangement = arrangement;
    requests.push_back(many);
  }
  int turn = 0;
  for (PackingRequest& request : requests)
  {
    const Bonds whole(request, 1.5);
    EXPECT_GT(whole.size(), 0u);
    const int many_pieces = whole.particles.size() < 1000 && turn % 3 == 0 ? 500 : 2;
    for (const int pieces :
      { 1, 2 + ++turn % 4, many_pieces }) // of 500 most have a particle or none
    {
      request.pieces = pieces;
      request.threads = 1 + pieces % 3;
      request.piece = 0;
      Bonds joined(request, 1.5);
      for (request.piece = 1; request.piece < pieces; ++request.piece)
      {
        joined.append(Bonds(request, 1.5));
      }
      EXPECT_TRUE(joined == whole) << whole.particles.size() << " grains, " << pieces << " pieces";
    }
  }
}

TEST(PackingBonds, ErrorsSayWhatCanBe)
{
  PackingRequest request;
  request.particles = 10;
  for (const double factor :
    { 0.0, 0.99, 3.01, -1.0, std::numeric_limits<double>::infinity(), std::nan("") })
  {
    EXPECT_EQ(bonds_error(request, factor),
      "expected a bond factor from 1 to 3, got " + std::to_string(factor));
  }
  EXPECT_EQ(bonds_error(request, 3), "");
}
