// SPDX-License-Identifier: BSD-3-Clause
// Chains and bundles: places from arithmetic, distances from a look at all pairs.
#include "../support/packings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
using granular::Arrangement;
using granular::PackingRequest;
using granular::Vector3;

PackingRequest fibres(Arrangement arrangement, std::int64_t grains, const std::string& boundary)
{
  PackingRequest request;
  request.arrangement = arrangement;
  request.grains = grains;
  request.boundary = boundary;
  request.radii = one_radius(0.5);
  return request;
}

std::vector<std::int64_t> numbers_of(const Grains& grains)
{
  for (const granular::DumpArray& array : grains.frame.arrays)
  {
    if (array.info.name == "mol")
    {
      const auto* const from = static_cast<const std::int64_t*>(array.block.data());
      return std::vector<std::int64_t>(from, from + grains.size());
    }
  }
  return {};
}

/// The least distance of two fibres, each a line along the first box vector.
double least_between(const Grains& grains, std::size_t each)
{
  const Vector3& along = grains.vectors[0];
  const double length = std::hypot(along[0], along[1], along[2]);
  double least = 1e300;
  for (std::size_t i = 0; i < grains.size(); i += each)
  {
    for (std::size_t j = 0; j < grains.size(); j += each)
    {
      for (int n = 0; n < 9; ++n)
      {
        const std::array<int, 2> moves = { n % 3 - 1, n / 3 - 1 };
        const std::string& boundary = grains.frame.header.box.boundary;
        if ((i == j && n == 4) || (moves[0] != 0 && boundary[3] != 'p') ||
          (moves[1] != 0 && boundary[6] != 'p'))
        {
          continue;
        }
        Vector3 edge;
        double part = 0;
        for (std::size_t k = 0; k < 3; ++k)
        {
          edge[k] = grains.points[j][k] - grains.points[i][k] + moves[0] * grains.vectors[1][k] +
            moves[1] * grains.vectors[2][k];
          part += edge[k] * along[k] / length;
        }
        double square = -part * part;
        for (const double value : edge)
        {
          square += value * value;
        }
        least = std::min(least, std::sqrt(std::max(square, 0.0)));
      }
    }
  }
  return least;
}
}

TEST(PackingFibres, AChainBeginsARadiusInsideAndIsInTheMiddle)
{
  PackingRequest request = fibres(Arrangement::Chain, 7, "f f f");
  request.box = tilted_box({ 1, 2, 3 }, { 12, 4, 6 });
  request.spacing = 1.25;
  const Grains grains(request);
  ASSERT_EQ(grains.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i)
  {
    EXPECT_NEAR(grains.points[i][0], 1.5 + 1.25 * static_cast<double>(i), 1e-13);
    EXPECT_NEAR(grains.points[i][1], 4, 1e-13);
    EXPECT_NEAR(grains.points[i][2], 6, 1e-13);
  }
  EXPECT_EQ(numbers_of(grains), std::vector<std::int64_t>(7, 1));
  const auto& columns = grains.frame.schema.columns();
  EXPECT_EQ(columns[2].name, "mol");
}

TEST(PackingFibres, AsManyAsTheBoxHolds)
{
  PackingRequest request = fibres(Arrangement::Chain, 0, "f f f");
  request.box = tilted_box({}, { 12, 4, 6 });
  EXPECT_EQ(Grains(request).size(), 12u);
  request.boundary = "p p p";
  EXPECT_EQ(Grains(request).size(), 12u);
  request.spacing = 1.1; // 11 / 1.1 gaps
  EXPECT_EQ(Grains(request).size(), 11u);
  request.arrangement = Arrangement::FibreBundle;
  request.spacing = 1;
  request.grains_per_fibre = 5;
  request.boundary = "f f f";
  // 4 fibres in a row, 3.5 in the next; a cell of two rows is sqrt(3) high, (6 - 1 - sqrt(3)/2)/sqrt(3) + 1 = 3.4
  EXPECT_EQ(Grains(request).size(), 5u * 3 * 2 * 3);
}

TEST(PackingFibres, ABoxIsMadeAroundAChain)
{
  PackingRequest request = fibres(Arrangement::Chain, 10, "f f f");
  request.spacing = 1.5;
  Grains walls(request);
  EXPECT_NEAR(walls.heights[0], 1 + 9 * 1.5, 1e-13);
  EXPECT_NEAR(walls.heights[1], 1, 1e-13);
  EXPECT_NEAR(walls.heights[2], 1, 1e-13);
  EXPECT_NEAR(walls.least_inside(), 0, 1e-13);
  request.boundary = "p p p";
  Grains periodic(request);
  EXPECT_NEAR(periodic.heights[0], 15, 1e-13);
  EXPECT_NEAR(periodic.heights[1], 1.5, 1e-13);
  EXPECT_NEAR(periodic.least_gap(), 0.5, 1e-13);
}

TEST(PackingFibres, BundlesAreInClosestPacking)
{
  const Grains grains(fibres(Arrangement::FibreBundle, 3 * 20 + 4, "f f f"));
  ASSERT_EQ(grains.size(), 64u);
  const std::vector<std::int64_t> numbers = numbers_of(grains);
  for (std::size_t i = 0; i < grains.size(); ++i)
  {
    EXPECT_EQ(numbers[i], static_cast<std::int64_t>(i / 20 + 1));
    EXPECT_NEAR(grains.points[i][0], 0.5 + static_cast<double>(i % 20), 1e-13);
  }
  const double high = std::sqrt(3.0) / 2;
  const Vector3 expected[] = { { 0.5, 0.5, 0.5 }, { 0.5, 1, 0.5 + high }, { 0.5, 1.5, 0.5 },
    { 0.5, 2, 0.5 + high } };
  for (std::size_t fibre = 0; fibre < 4; ++fibre)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      EXPECT_NEAR(grains.points[20 * fibre][k], expected[fibre][k], 1e-12) << fibre;
    }
  }
  EXPECT_NEAR(grains.least_gap(), 0, 1e-12);
  EXPECT_NEAR(grains.least_inside(), 0, 1e-12);
}

TEST(PackingFibres, NoneOverlapInAnyBox)
{
  const Vector3 tilts[] = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, -3, 1 }, { 4, 4, 4 }, { -11, 7, 13 } };
  for (const Vector3& tilt : tilts)
  {
    for (const char* const boundary : { "p p p", "f f f", "p f p", "m s p" })
    {
      PackingRequest request = fibres(Arrangement::FibreBundle, 0, boundary);
      request.box = tilted_box({ -3, 0, 9 }, { 19, 11, 8 }, tilt);
      request.grains_per_fibre = 6;
      request.spacing = 1.01;
      const Grains grains(request);
      EXPECT_GT(grains.size(), 6u * 3);
      EXPECT_GT(grains.least_gap(), 0.01 - 1e-11) << boundary << " " << tilt[0];
      EXPECT_GT(least_between(grains, 6), 1.01 - 1e-11) << boundary << " " << tilt[0];
      EXPECT_GT(grains.least_inside(), -1e-12) << boundary << " " << tilt[0];
      request.arrangement = Arrangement::Chain;
      const Grains chain(request);
      EXPECT_GT(chain.size(), 6u);
      EXPECT_GT(chain.least_gap(), -1e-11) << boundary << " " << tilt[0];
      EXPECT_GT(chain.least_inside(), -1e-12) << boundary << " " << tilt[0];
    }
  }
}

TEST(PackingFibres, ABoxIsMadeForABundle)
{
  for (const std::int64_t number : { 1, 2, 19, 20, 21, 500, 2001 })
  {
    for (const char* const boundary : { "p p p", "f f f", "f p f" })
    {
      const Grains grains(fibres(Arrangement::FibreBundle, number, boundary));
      ASSERT_EQ(grains.size(), static_cast<std::size_t>(number));
      EXPECT_EQ(numbers_of(grains).back(), (number - 1) / 20 + 1);
      EXPECT_GT(grains.least_gap(), -1e-12);
      EXPECT_GT(grains.least_inside(), -1e-12);
      const auto [least, most] =
        std::minmax_element(grains.heights.begin() + 1, grains.heights.end());
      EXPECT_LT(*most / *least, 3);
    }
  }
}

TEST(PackingFibres, ErrorsSayWhatFits)
{
  PackingRequest request = fibres(Arrangement::Chain, 9, "p p p");
  request.box = tilted_box({}, { 8, 4, 4 });
  EXPECT_EQ(error_of(request),
    "expected at most 8 grains a fibre, which the box holds along its first vector, got 9");
  request.arrangement = Arrangement::FibreBundle;
  EXPECT_EQ(error_of(request),
    "expected at most 8 grains a fibre, which the box holds along its first vector, got 9");
  request.grains_per_fibre = 8;
  EXPECT_EQ(error_of(request), "");
  request.grains = 8 * 4 * 2 * 2 + 1;
  EXPECT_EQ(
    error_of(request), "expected at most 128 grains, which the box holds in these fibres, got 129");
  request.grains_per_fibre = 0;
  EXPECT_EQ(
    error_of(request), "expected a number of grains per fibre from 1 to 10^12, got 0.000000");
  request.grains_per_fibre = 2;
  request.box = tilted_box({}, { 8, 4, 1.5 });
  EXPECT_EQ(error_of(request),
    "expected a box that holds a cell of the fibre bundle, got one of height 1.500000 along vector "
    "3, where "
    "a cell needs 1.732051");
}
