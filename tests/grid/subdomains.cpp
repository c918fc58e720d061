// SPDX-License-Identifier: BSD-3-Clause
#include "granular/grid/subdomains.h"

#include "../support/quad.h"
#include "made_subdomains.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

using namespace granular;

namespace
{
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();
}

TEST(BoundsOf, smallest_box)
{
  EXPECT_EQ(bounds_of({}), made_subdomain({}, {}));
  const Subdomains one = { made_subdomain({ -1, 2, 3 }, { 4, 5, 6 }, 7, 8) };
  EXPECT_EQ(bounds_of(one), made_subdomain({ -1, 2, 3 }, { 4, 5, 6 }));
  const Subdomains some = { made_subdomain({ 0, 0, 0 }, { 1, 1, 1 }),
    made_subdomain({ -3, 0.5, 2 }, { -2, 0.6, 9 }) };
  EXPECT_EQ(bounds_of(some), made_subdomain({ -3, 0, 0 }, { 1, 1, 9 }));
  const Subdomains odd = { made_subdomain({ no_number, 0, -infinity }, { no_number, 1, 1 }),
    made_subdomain({ 2, no_number, 0 }, { 3, no_number, 4 }) };
  EXPECT_EQ(bounds_of(odd), made_subdomain({ 2, 0, -infinity }, { 3, 1, 4 }));
  const Subdomains inverted = { made_subdomain({ 3, no_number, 0 }, { 1, no_number, 1 }) };
  EXPECT_EQ(bounds_of(inverted), made_subdomain({ 1, 0, 0 }, { 3, 0, 1 }));
  EXPECT_EQ(bounds_of(made_grid({ 7, 5, 3 })), made_subdomain({ -1, 0, 1e3 }, { 1, 3, 1004 }));
}

TEST(ImbalanceOf, largest_by_mean)
{
  const auto of = [](const std::vector<std::int64_t>& particles, std::int64_t processes = 0)
  {
    Subdomains subdomains;
    for (const std::int64_t count : particles)
    {
      subdomains.push_back(made_subdomain({}, {}, count));
    }
    return imbalance_of(subdomains, processes);
  };
  EXPECT_EQ(of({}), 1);
  EXPECT_EQ(of({ 0, 0, 0 }), 1);
  EXPECT_EQ(of({ 5 }), 1);
  EXPECT_EQ(of({ 10, 10, 10 }), 1);
  EXPECT_EQ(of({ 30, 0, 0 }), 3);
  EXPECT_EQ(of({ 6, 2 }), 1.5);
  EXPECT_EQ(of({ 6, 2 }, 4), 3); // two more without a subdomain
  const std::int64_t many = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(of({ many, many, many, many }), 1);
}

/// Against quotients of 113 bits, rounded once.
TEST(ImbalanceOf, is_the_nearest_double)
{
  const std::vector<Subdomain> one = { made_subdomain({}, {}, 4711) };
  for (std::int64_t processes = 1; processes < 5000; ++processes)
  {
    EXPECT_EQ(imbalance_of(one, processes), static_cast<double>(processes));
  }
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i)
  {
    Subdomains subdomains;
    std::int64_t largest = 1;
    std::int64_t total = 1;
    subdomains.push_back(made_subdomain({}, {}, 1));
    for (std::uint64_t n = random() % 100; n > 0; --n)
    {
      const auto count = static_cast<std::int64_t>(random() % 10'000'000'000);
      subdomains.push_back(made_subdomain({}, {}, count));
      largest = std::max(largest, count);
      total += count;
    }
    const auto expected = Quad(largest) * static_cast<std::int64_t>(subdomains.size()) / total;
    EXPECT_EQ(imbalance_of(subdomains), static_cast<double>(expected));
  }
}
