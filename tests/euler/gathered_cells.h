// SPDX-License-Identifier: BSD-3-Clause
// The cells of all ranks come to the first one: called on all ranks.
#ifndef granular_tests_euler_gathered_cells_h
#define granular_tests_euler_gathered_cells_h

#include "granular/euler/cells.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

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

/// B = [B(0), ..., B(P - 1)], on rank 0.
inline void check_gathered_buffers(granular::Communicator& ranks)
{
  const auto buffer = [](int rank)
  { return std::vector<double>(static_cast<std::size_t>(9 * count_of_rank(rank)), 1e9 + rank); };
  const std::vector<double> all =
    granular::gather_packed(buffer(ranks.rank()), count_of_rank(ranks.rank()), ranks);
  std::vector<double> expected;
  for (int rank = 0; ranks.rank() == 0 && rank < ranks.size(); ++rank)
  {
    append(expected, buffer(rank));
  }
  EXPECT_EQ(all, expected);
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

/// n_all = 9 N: the last rank has one value too few, and all hear of it.
inline void check_counts(granular::Communicator& ranks)
{
  const int last = ranks.size() - 1;
  const std::vector<double> own(ranks.rank() == last ? 17 : 18);
  std::string said;
  try
  {
    granular::gather_packed(own, 2, ranks);
  }
  catch (const granular::FormatError& error)
  {
    said = error.what();
  }
  const std::string expected =
    "expected 9 values for each of 2 cells of process " + std::to_string(last) + ", got 17";
  EXPECT_EQ(said.substr(0, expected.size()), expected);
}
#endif
