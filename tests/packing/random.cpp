// SPDX-License-Identifier: BSD-3-Clause
// Grains at random places: none overlap, all are there, and their distribution is that of random sequential adsorption.
#include "../support/hard_case.h"
#include "../support/packings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <ostream>
#include <random>

namespace
{
using granular::PackingRequest;
using granular::RadiusChoice;
using granular::Vector3;

struct Case
{
  const char* name;
  granular::Box box;
  const char* boundary;
  RadiusChoice radii;
  double solid_fraction;

  friend void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }
};

PackingRequest request_of(const Case& each)
{
  PackingRequest request;
  request.box = each.box;
  request.boundary = each.boundary;
  request.radii = each.radii;
  request.solid_fraction = each.solid_fraction;
  return request;
}

const Case cases[] = {
  { "walls", tilted_box({}, { 25, 20, 30 }), "f f f", one_radius(0.5), 0.2 },
  { "periodic", tilted_box({ -7, 3, 0 }, { 25, 20, 30 }), "p p p", one_radius(0.5), 0.2 },
  { "dense", tilted_box({}, { 20, 20, 20 }), "p p p", one_radius(0.5), 0.3 },
  { "mixed faces", tilted_box({}, { 20, 25, 22 }), "p f p", one_radius(0.5), 0.25 },
  { "tilted", tilted_box({}, { 20, 25, 22 }, { 7, -10, 6 }), "p p p", one_radius(0.5), 0.2 },
  { "strongly tilted", tilted_box({ 1, 1, 1 }, { 20, 25, 22 }, { 50, -40, 60 }), "p s p",
    one_radius(0.5), 0.15 },
  { "two sizes", tilted_box({}, { 30, 35, 32 }), "p p f", two_radii(0.4, 1, 0.3), 0.3 },
  { "two sizes, tilted", tilted_box({}, { 30, 35, 32 }, { 10, 0, 0 }), "p m p",
    two_radii(1, 0.3, 0.9), 0.3 },
  { "20 to 1", tilted_box({}, { 31, 31, 15 }), "p p p", two_radii(0.05, 1, 0.01), 0.05 },
  { "a needle", tilted_box({}, { 250, 1.5, 1.2 }), "p f p", one_radius(0.5), 0.1 },
  { "a layer", tilted_box({}, { 45, 40, 1 }), "p p f", one_radius(0.5), 0.2 },
  { "a periodic layer", tilted_box({}, { 45, 40, 1.5 }, { 0, 15, 10 }), "f p p", one_radius(0.5),
    0.2 },
  { "thin, periodic", tilted_box({}, { 5, 5, 60 }), "p p p", one_radius(0.5), 0.25 },
  { "two cells across", tilted_box({}, { 2.3, 2.6, 30 }, { 0.4, 1, -2 }), "p p p", one_radius(0.5),
    0.2 },
  { "sparse", tilted_box({}, { 1e3, 1e3, 1e3 }), "p p f", one_radius(0.5), 1e-6 },
  { "far away", tilted_box({ 1e6, -1e6, 1e6 }, { 0.05, 0.05, 0.05 }), "p p p", one_radius(5e-4),
    0.25 },
};

class PackingRandom : public testing::TestWithParam<Case>
{
};

constexpr std::size_t bins = 24;
using Histogram = std::array<double, bins>;

double square_distance(const Vector3& a, const Vector3& b, double edge)
{
  double square = 0;
  for (std::size_t k = 0; k < 3; ++k)
  {
    const double away = a[k] - b[k];
    square += std::pow(away - edge * std::round(away / edge), 2);
  }
  return square;
}

/// Numbers of pairs by their gap in eighths.
Histogram pairs_of(
  const std::vector<Vector3>& points, const std::vector<double>& radii, double edge)
{
  Histogram counts = {};
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const double gap =
        std::sqrt(square_distance(points[i], points[j], edge)) - radii[i] - radii[j];
      const auto bin = static_cast<std::size_t>(8 * gap);
      if (bin < bins)
      {
        ++counts[bin];
      }
    }
  }
  return counts;
}

std::vector<Vector3> plain_adsorption(
  const std::vector<double>& radii, double edge, std::uint64_t seed)
{
  std::mt19937_64 numbers(seed);
  std::uniform_real_distribution<double> anywhere(0, edge);
  std::vector<Vector3> points;
  while (points.size() < radii.size())
  {
    const Vector3 place = { anywhere(numbers), anywhere(numbers), anywhere(numbers) };
    bool fits = true;
    for (std::size_t i = 0; fits && i < points.size(); ++i)
    {
      fits =
        square_distance(points[i], place, edge) >= std::pow(radii[i] + radii[points.size()], 2);
    }
    if (fits)
    {
      points.push_back(place);
    }
  }
  return points;
}

struct Moments
{
  void add(const Histogram& counts)
  {
    for (std::size_t i = 0; i < bins; ++i)
    {
      sum[i] += counts[i];
      squares[i] += counts[i] * counts[i];
    }
    ++times;
  }

  double mean(std::size_t i) const { return sum[i] / times; }

  /// The variance of the mean.
  double variance(std::size_t i) const
  {
    return (squares[i] / times - std::pow(this->mean(i), 2)) / (times - 1);
  }

  Histogram sum = {};
  Histogram squares = {};
  double times = 0;
};

double volume_of(double radius)
{
  return 4 * std::acos(-1.0) / 3 * radius * radius * radius;
}
}

TEST_P(PackingRandom, NoneOverlapAndAllAreInside)
{
  const Grains particles(request_of(GetParam()));
  ASSERT_GT(particles.size(), 10u);
  HardCase hard("packings", "random particles: overlap of the nearest two", "diameters", 0);
  hard.add(std::max(0.0, -particles.least_gap()), static_cast<std::int64_t>(particles.size()));
  EXPECT_GT(particles.least_gap(), 0);
  EXPECT_GE(particles.least_inside(), GetParam().boundary == std::string("f f f") ? 0 : -1e-9);
  const double largest = *std::max_element(particles.radius.begin(), particles.radius.end());
  const double missing = GetParam().solid_fraction - particles.solid_fraction();
  EXPECT_LE(std::abs(missing), 1.01 * volume_of(largest) / particles.volume);
}

INSTANTIATE_TEST_SUITE_P(All, PackingRandom, testing::ValuesIn(cases));

TEST(PackingRandomCounts, IdsCountFromOneAndSharesAreExact)
{
  PackingRequest request;
  request.particles = 12345;
  request.radii = two_radii(0.3, 0.5, 0.4);
  request.speed = 2;
  const Grains particles(request);
  ASSERT_EQ(particles.size(), 12345u);
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    ASSERT_EQ(particles.id[i], static_cast<std::int64_t>(i) + 1);
    ASSERT_EQ(particles.type[i], particles.radius[i] == 0.5 ? 2 : 1);
  }
  EXPECT_EQ(std::count(particles.type.begin(), particles.type.end(), 2), 4938);
  EXPECT_NEAR(particles.solid_fraction(), 0.2, 1e-9);
  EXPECT_EQ(particles.frame.schema.text(), "id type x y z radius vx vy vz");
}

TEST(PackingRandomCounts, SmallNumbers)
{
  for (const std::int64_t number : { 1, 2, 10, 100 })
  {
    for (const char* const boundary : { "p p p", "f f f" })
    {
      PackingRequest request;
      request.particles = number;
      request.boundary = boundary;
      request.radii = one_radius(0.01);
      request.solid_fraction = 0.05;
      const Grains particles(request);
      ASSERT_EQ(particles.size(), static_cast<std::size_t>(number));
      EXPECT_GT(particles.least_gap(), 0);
      EXPECT_NEAR(particles.solid_fraction(), 0.05, 1e-9);
      request.box = tilted_box({}, { 1e4, 1e4, 1e4 });
      EXPECT_EQ(Grains(request).size(), static_cast<std::size_t>(number));
    }
  }
  PackingRequest snug; // a particle that touches all faces
  snug.particles = 1;
  snug.box = tilted_box({}, { 1, 1, 1 });
  snug.radii = one_radius(0.5);
  EXPECT_EQ(Grains(snug).points[0], (Vector3{ 0.5, 0.5, 0.5 }));
}

// few particles between walls have little of the room that the solid fraction says
TEST(PackingRandomCounts, ABoxThatIsMadeHasRoom)
{
  const double particle = volume_of(0.5);
  for (const RadiusChoice& radii : { one_radius(0.5), two_radii(0.3, 0.5, 0.3) })
  {
    for (std::int64_t number = 1; number < 100; number += number < 20 ? 1 : 17)
    {
      for (const char* const boundary : { "p p p", "f f f" })
      {
        PackingRequest request;
        request.particles = number;
        request.boundary = boundary;
        request.radii = radii;
        request.solid_fraction = 0.3;
        request.seed = static_cast<std::uint64_t>(number);
        const Grains particles(request);
        ASSERT_EQ(particles.size(), static_cast<std::size_t>(number));
        EXPECT_GT(particles.least_gap(), 0);
        EXPECT_GE(particles.least_inside(), 0);
        EXPECT_LT(particles.solid_fraction(), 0.3 + 2 * particle / particles.volume);
      }
    }
  }
}

TEST(PackingRandomCounts, VelocitiesAreNormal)
{
  PackingRequest request;
  request.particles = 100000;
  request.arrangement = granular::Arrangement::SimpleCubic;
  request.speed = 3;
  const Grains particles(request);
  double sum = 0;
  double squares = 0;
  double fourths = 0;
  double products = 0;
  int beyond = 0;
  for (const Vector3& v : particles.v)
  {
    for (const double component : v)
    {
      sum += component / 3;
      squares += std::pow(component / 3, 2);
      fourths += std::pow(component / 3, 4);
      beyond += std::abs(component) > 6 ? 1 : 0;
    }
    products += v[0] * v[1] / 9;
  }
  // within five standard deviations of what 300000 numbers of the normal distribution give
  EXPECT_NEAR(sum / 3e5, 0, 5 * std::sqrt(1 / 3e5));
  EXPECT_NEAR(squares / 3e5, 1, 5 * std::sqrt(2 / 3e5));
  EXPECT_NEAR(fourths / 3e5, 3, 5 * std::sqrt(96 / 3e5));
  EXPECT_NEAR(beyond / 3e5, std::erfc(std::sqrt(2.0)), 5 * std::sqrt(0.0455 / 3e5));
  EXPECT_NEAR(products / 1e5, 0, 5 * std::sqrt(1 / 1e5));
  request.speed = 0;
  EXPECT_EQ(Grains(request).v[17], (Vector3{ 0, 0, 0 }));
}

// Counts in thin slices: of 1000 sets of even places, 999 have a chi^2 below 72 for 39 degrees of freedom.
TEST(PackingRandomPlaces, AreEven)
{
  PackingRequest request;
  request.box = tilted_box({}, { 50, 50, 50 });
  request.boundary = "p p p";
  request.radii = one_radius(0.5);
  request.solid_fraction = 0.25;
  const Grains particles(request);
  constexpr std::size_t slices = 40;
  const double expected = static_cast<double>(particles.size()) / slices;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    std::vector<double> counts(slices);
    for (const Vector3& point : particles.points)
    {
      ++counts[std::min(static_cast<std::size_t>(point[axis] / 50 * slices), slices - 1)];
    }
    double chi_square = 0;
    for (const double count : counts)
    {
      chi_square += (count - expected) * (count - expected) / expected;
    }
    EXPECT_LT(chi_square, 72) << "axis " << axis;
  }
}

// By a program as simple as can be, which looks at all earlier particles, with a generator of the standard library.
TEST(PackingRandomPlaces, PairsAreThoseOfPlainAdsorption)
{
  constexpr double edge = 14;
  constexpr int times = 75;
  std::array<Moments, 2> both;
  for (int seed = 1; seed <= times; ++seed)
  {
    PackingRequest request;
    request.box = tilted_box({}, { edge, edge, edge });
    request.boundary = "p p p";
    request.radii = two_radii(0.6, 1, 0.3);
    request.solid_fraction = 0.28;
    request.seed = static_cast<std::uint64_t>(seed);
    const Grains particles(request);
    both[0].add(pairs_of(particles.points, particles.radius, edge));
    std::vector<double> radii = particles.radius;
    std::ranges::sort(radii, std::greater());
    both[1].add(pairs_of(plain_adsorption(radii, edge, request.seed), radii, edge));
  }
  double sum = 0;
  for (std::size_t i = 0; i < bins; ++i)
  {
    const double difference = both[0].mean(i) - both[1].mean(i);
    sum += difference * difference / (both[0].variance(i) + both[1].variance(i));
  }
  EXPECT_LT(sum / bins, 2); // 1 is expected
}

TEST(PackingRandomPlaces, AnotherSeedGivesOthers)
{
  PackingRequest request;
  request.particles = 1000;
  request.radii = two_radii(0.2, 0.4, 0.5);
  request.speed = 1;
  const Grains one(request);
  request.seed = 2;
  const Grains two(request);
  int same_places = 0;
  for (std::size_t i = 0; i < 1000; ++i)
  {
    same_places += one.points[i] == two.points[i] ? 1 : 0;
  }
  EXPECT_EQ(same_places, 0);
  EXPECT_NE(one.radius, two.radius);
  EXPECT_NE(one.v, two.v);
}
