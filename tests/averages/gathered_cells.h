// SPDX-License-Identifier: BSD-3-Clause
// The cells of all ranks come to the first one: called on all ranks.
#ifndef granular_tests_euler_gathered_cells_h
#define granular_tests_euler_gathered_cells_h

#include "granular/grid/cells.h"

#include <gtest/gtest.h>

#include <limits>

/// Cells whose values tell whose they are; no two are equal.
inline granular::EulerCells cells_of_rank(int rank, std::int64_t count, bool stresses = false)
{
  granular::EulerCells cells;
  double next = 1000 * rank;
  const auto fill = [&](std::vector<double>& values, std::int64_t size)
  {
    for (std::int64_t i = 0; i < size; ++i)
    {
      values.push_back(next += 1 + std::numeric_limits<double>::epsilon());
    }
  };
  fill(cells.centres, 3 * count);
  for (const granular::EulerArray& array : granular::euler_arrays())
  {
    if (stresses || !array.optional)
    {
      fill(cells.*array.values, array.components * count);
    }
  }
  return cells;
}

/// Rank 1 has none, others as many as their number says.
inline std::int64_t count_of_rank(int rank)
{
  return rank == 1 ? 0 : rank + 2;
}

inline void append(std::vector<double>& to, const std::vector<double>& from)
{
  to.insert(to.end(), from.begin(), from.end());
}

inline void check_gathered_cells(granular::Communicator& ranks)
{
  for (const bool stresses : { false, true })
  {
    const granular::EulerCells all = granular::gather_cells(
      cells_of_rank(ranks.rank(), count_of_rank(ranks.rank()), stresses), ranks);
    granular::EulerCells expected;
    for (int rank = 0; ranks.rank() == 0 && rank < ranks.size(); ++rank)
    {
      const granular::EulerCells part = cells_of_rank(rank, count_of_rank(rank), stresses);
      append(expected.centres, part.centres);
      for (const granular::EulerArray& array : granular::euler_arrays())
      {
        append(expected.*array.values, part.*array.values);
      }
    }
    EXPECT_EQ(all, expected);
  }
}
#endif
