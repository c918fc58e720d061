// SPDX-License-Identifier: BSD-3-Clause
// Cells, gathered from processes that are threads.
#include "granular/grid/cells.h"

#include "../averages/gathered_cells.h"
#include "../support/thread_ranks.h"

#include <gtest/gtest.h>

using namespace granular;

TEST(EulerCells, arrays_of_liggghts_and_pfm)
{
  std::string names;
  for (const EulerArray& array : euler_arrays())
  {
    names += std::string(array.name) + " " + std::to_string(array.components) +
      (array.optional ? "? " : " ");
  }
  EXPECT_EQ(names, "v_avg 3 volumefraction 1 radius 1 pressure 1 sigma 3? tau 3? ");
}

TEST(EulerCells, new_ones_are_empty)
{
  EulerCells cells;
  EXPECT_EQ(cells.count(), 0);
  cells.resize(2);
  EXPECT_EQ(cells.count(), 2);
  const EulerCells expected = { std::vector<double>(6), std::vector<double>(6),
    std::vector<double>(2), std::vector<double>(2), std::vector<double>(2), {}, {} };
  EXPECT_EQ(cells, expected);
}

TEST(GatherCells, one_process)
{
  SerialCommunicator alone;
  check_gathered_cells(alone);
}

TEST(GatherCells, ranks)
{
  for (const int size : { 2, 3, 7 })
  {
    run_ranks(size, check_gathered_cells);
  }
}

/// Stresses are known where all who have cells know them.
TEST(GatherCells, stresses_that_some_know)
{
  run_ranks(3,
    [](Communicator& ranks)
    {
      // rank 1 has no cells, so nobody asks what it knows
      EulerCells own = cells_of_rank(ranks.rank(), count_of_rank(ranks.rank()), ranks.rank() != 1);
      if (ranks.rank() == 2)
      {
        own.shear_stress.clear();
      }
      const EulerCells all = gather_cells(own, ranks);
      EXPECT_EQ(all.count(), ranks.rank() == 0 ? 6 : 0);
      EXPECT_EQ(all.normal_stress.size(), ranks.rank() == 0 ? 18u : 0u);
      EXPECT_TRUE(all.shear_stress.empty());
    });
}

/// One rank fails, and none waits.
TEST(GatherCells, a_rank_with_odd_arrays)
{
  run_ranks(3,
    [](Communicator& ranks)
    {
      EulerCells own = cells_of_rank(ranks.rank(), 2);
      if (ranks.rank() == 1)
      {
        own.centres.pop_back();
      }
      EXPECT_ANY_THROW(gather_cells(own, ranks));
    });
}
