// SPDX-License-Identifier: BSD-3-Clause
// Lattices, chains and bundles do not overlap: squares of distances against squares of sums of radii, in 113 bits, which
// hold differences and squares of the doubles here.
#include "../support/hard_case.h"
#include "../support/packings.h"
#include "../support/quad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace
{
using granular::Arrangement;
using granular::PackingRequest;
using granular::Vector3;

constexpr Arrangement arrangements[] = { Arrangement::SimpleCubic, Arrangement::FaceCentredCubic,
  Arrangement::Hexagonal, Arrangement::Chain, Arrangement::FibreBundle };

/// By how much the nearest two overlap, their periodic images among them, in diameters: 0 where none do.
double overlap_of(const Grains& grains)
{
  const granular::Box& box = grains.frame.header.box;
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
    for (std::size_t i = 0; there && i < grains.size(); ++i)
    {
      for (std::size_t j = 0; j <= i; ++j)
      {
        const double sum = grains.radius[i] + grains.radius[j];
        double rough = 0;
        Quad square = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const Quad away =
            static_cast<Quad>(grains.points[i][axis]) - grains.points[j][axis] + shift[axis];
          rough += static_cast<double>(away) * static_cast<double>(away);
          square += away * away;
        }
        if ((i != j || n != 13) && rough < 1.1 * sum * sum)
        {
          const Quad least = static_cast<Quad>(grains.radius[i]) + grains.radius[j];
          worst = std::max(worst, (least * least - square) / (2 * least * least));
        }
      }
    }
  }
  return static_cast<double>(worst);
}

PackingRequest request_of(Arrangement arrangement, const std::string& boundary, double radius)
{
  PackingRequest request;
  request.arrangement = arrangement;
  request.boundary = boundary;
  request.radii = one_radius(radius);
  request.grains_per_fibre = 4;
  return request;
}
}

/// A box with room along x and z, and none along y. 128 pairs once overlapped by 1e-16.
TEST(PackingOverlap, ABoxThatIsTightAlongOneAxis)
{
  PackingRequest request = request_of(Arrangement::SimpleCubic, "f f f", 0.5);
  request.box = tilted_box({}, { 6.785606236300253, 10, 8.283244719637754 });
  const Grains grains(request);
  EXPECT_EQ(grains.size(), 6u * 10 * 8);
  EXPECT_EQ(overlap_of(grains), 0);
  EXPECT_EQ(grains.radius[0], 0.5);
  EXPECT_EQ(grains.points[0][1], 0.5);
}

TEST(PackingOverlap, NoneInAnyBox)
{
  HardCase hard("packings",
    "lattices, chains and bundles in boxes that hold them exactly or with room, straight or "
    "tilted, "
    "up to 1e6 away, in 113 bits: overlap of the nearest two",
    "diameters", 0);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  for (std::size_t i = 0; i < 140; ++i)
  {
    const double radius = i % 3 == 0 ? 0.5 : i % 3 == 1 ? 0.1 : 0.05 + part(random);
    PackingRequest request = request_of(
      arrangements[i % 5], std::array{ "f f f", "p p p", "p f p", "f p f" }[i / 5 % 4], radius);
    const double far = i % 7 < 4 ? 0 : std::array{ 0.1, 1e3, 1e6 }[i % 7 - 4];
    Vector3 lengths;
    for (double& length : lengths)
    {
      // whole numbers of diameters, but for the last bits, or any length
      const double diameters = 4 + std::floor(2 * part(random));
      length = 2 * radius * (i % 2 == 0 ? diameters : diameters + part(random));
    }
    const Vector3 tilts = { radius * part(random), -radius * part(random), 0.5 * radius };
    request.box = tilted_box({ far, -far, 2 * far }, lengths, i % 4 == 3 ? tilts : Vector3{});
    const Grains grains(request);
    hard.add(overlap_of(grains), static_cast<std::int64_t>(grains.size()));
    for (const double made : grains.radius)
    {
      EXPECT_LE(made, radius);
      EXPECT_GT(made, radius * (1 - 1e-13) - 1e-14 * far);
    }
    EXPECT_GT(grains.least_inside(), -1e-12 * (1 + far));
  }
}

/// Straight boxes hold as many as arithmetic says, also where the last bits of the length are missing.
TEST(PackingOverlap, AsManyAsFit)
{
  PackingRequest request = request_of(Arrangement::SimpleCubic, "f p f", 0.1);
  request.box = tilted_box({ 0.3, 0, 0 }, { 1, 0.6, 0.8 });
  EXPECT_EQ(Grains(request).size(), 5u * 3 * 4);
  request.arrangement = Arrangement::Chain;
  EXPECT_EQ(Grains(request).size(), 5u);
}

/// Boxes that are made leave the room that rounding takes: radii are those asked for.
TEST(PackingOverlap, NoneInBoxesThatAreMade)
{
  for (const Arrangement arrangement : arrangements)
  {
    for (const char* const boundary : { "p p p", "f f f", "p f p" })
    {
      for (const double radius : { 0.5, 0.3, 0.001 })
      {
        PackingRequest request = request_of(arrangement, boundary, radius);
        request.grains = 60;
        request.corner = { 0.1, -3, 1e3 };
        const Grains grains(request);
        EXPECT_EQ(grains.size(), 60u);
        EXPECT_EQ(overlap_of(grains), 0);
        EXPECT_EQ(*std::ranges::min_element(grains.radius), radius);
      }
    }
  }
}
