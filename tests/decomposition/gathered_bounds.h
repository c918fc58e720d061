// SPDX-License-Identifier: BSD-3-Clause
// The bounds of all ranks come to the first one: called on all ranks.
#ifndef tests_decomposition_gathered_bounds_h
#define tests_decomposition_gathered_bounds_h

#include "granular/decomposition/subdomains.h"

#include <gtest/gtest.h>

#include <limits>

inline void check_gathered(granular::Communicator& ranks)
{
  constexpr double ulp = std::numeric_limits<double>::epsilon();
  const double p = ranks.rank();
  const granular::Subdomain own = { { p, -p, 1e9 + p }, { p + ulp, -0.0, 2e9 },
    (std::int64_t{ 1 } << 40) + ranks.rank(), 999 };
  const granular::GatheredBounds gathered = granular::gather_bounds(own, ranks);
  granular::GatheredBounds expected;
  for (int i = 0; ranks.rank() == 0 && i < ranks.size(); ++i)
  {
    expected.x_data.insert(expected.x_data.end(), { 1.0 * i, i + ulp });
    expected.y_data.insert(expected.y_data.end(), { -1.0 * i, -0.0 });
    expected.z_data.insert(expected.z_data.end(), { 1e9 + i, 2e9 });
    expected.particles.push_back((std::int64_t{ 1 } << 40) + i);
  }
  EXPECT_EQ(gathered.x_data, expected.x_data);
  EXPECT_EQ(gathered.y_data, expected.y_data);
  EXPECT_EQ(gathered.z_data, expected.z_data);
  EXPECT_EQ(gathered.particles, expected.particles);
}

#endif
