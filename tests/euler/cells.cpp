// SPDX-License-Identifier: BSD-3-Clause
// Cells, packed as dump euler/vtk packs them, and gathered from processes that are threads.
#include "granular/euler/cells.h"

#include "granular/common/error.h"

#include "../support/thread_ranks.h"
#include "gathered_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

/// Value j of cell i, from 1, is buffer[9 (i - 1) + j - 1]: x y z u v w phi r p.
TEST(PackCells, nine_values_each)
{
  const EulerCells cells = { { 1, 2, 3, 10, 20, 30 }, { 4, 5, 6, 40, 50, 60 }, { 7, 70 }, { 8, 80 },
    { 9, 90 }, { 1, 1, 1, 1, 1, 1 }, {} };
  std::vector<double> buffer(18);
  pack_cells(cells, buffer);
  for (std::size_t i = 1; i <= 2; ++i)
  {
    for (std::size_t j = 1; j <= 9; ++j)
    {
      EXPECT_EQ(buffer[9 * (i - 1) + j - 1], static_cast<double>(i == 1 ? j : 10 * j));
    }
  }
  EulerCells back = unpack_cells(buffer);
  back.normal_stress = cells.normal_stress; // which are left out
  EXPECT_EQ(back, cells);
}

TEST(PackCells, bits_are_kept)
{
  EulerCells cells;
  cells.resize(1);
  cells.pressure[0] = -0.0;
  cells.radius[0] = -std::numeric_limits<double>::quiet_NaN();
  cells.centres[0] = std::numeric_limits<double>::denorm_min();
  std::vector<double> buffer(9);
  pack_cells(cells, buffer);
  const EulerCells back = unpack_cells(buffer);
  EXPECT_TRUE(std::signbit(back.pressure[0]));
  EXPECT_TRUE(std::isnan(back.radius[0]) && std::signbit(back.radius[0]));
  EXPECT_EQ(back.centres[0], std::numeric_limits<double>::denorm_min());
}

TEST(PackCells, sizes_are_checked)
{
  EulerCells cells;
  cells.resize(2);
  std::vector<double> buffer(17);
  EXPECT_THROW(pack_cells(cells, buffer), std::logic_error);
  buffer.resize(18);
  cells.velocities.pop_back();
  EXPECT_THROW(pack_cells(cells, buffer), std::logic_error);
  EXPECT_EQ(unpack_cells({}).count(), 0);
  try
  {
    unpack_cells(std::span(buffer).first(17));
    ADD_FAILURE() << "expected an error";
  }
  catch (const FormatError& error)
  {
    EXPECT_STREQ(error.what(), "expected 9 values for each cell, got 17 values");
  }
}

TEST(GatherCells, one_process)
{
  SerialCommunicator alone;
  check_gathered_buffers(alone);
  check_gathered_cells(alone);
  check_counts(alone);
  EXPECT_TRUE(gather_packed({}, 0, alone).empty());
  EXPECT_THROW(gather_packed(std::vector<double>(9), 2, alone), FormatError);
  EXPECT_THROW(gather_packed({}, -1, alone), FormatError);
  EXPECT_THROW(gather_packed({}, std::int64_t{ 1 } << 62, alone), FormatError);
}

TEST(GatherCells, ranks)
{
  for (const int size : { 2, 3, 7 })
  {
    run_ranks(size, check_gathered_buffers);
    run_ranks(size, check_gathered_cells);
    run_ranks(size, check_counts);
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
