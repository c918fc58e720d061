// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun.
#include "granular/mpi/mpi_communicator.h"
#include "granular/paths/id_selection.h"

#include "path_checks.h"

#include <gtest/gtest.h>

TEST(PathRanks, Everywhere)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD);
  path_checks::check_walks(ranks);
  path_checks::check_deformed(ranks);
  path_checks::check_few(ranks);
}

/// Values that are cut by the ends of messages.
TEST(PathRanks, SmallMessages)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD, 1001);
  path_checks::check_walks(ranks);
}

/// Sums, quantiles and samples of all ranks are those of one.
TEST(PathRanks, Statistics)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD);
  granular::SerialCommunicator alone;
  std::mt19937_64 random(3);
  std::vector<double> numbers;
  std::vector<double> own;
  std::vector<std::int64_t> ids;
  std::vector<std::int64_t> own_ids;
  for (std::size_t i = 0; i < 5000; ++i)
  {
    numbers.push_back(
      std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 600) - 300));
    ids.push_back(static_cast<std::int64_t>(random() % 9000) - 4000);
    if (path_checks::by_rows(1, i, ranks.size()) == ranks.rank())
    {
      own.push_back(numbers.back());
      own_ids.push_back(ids.back());
    }
  }
  const std::vector<double> parts = { 0.25, 0.5, 0.75, 1 };
  const granular::Statistics expected = find_statistics(numbers, parts, alone);
  const granular::Statistics found = find_statistics(own, parts, ranks);
  EXPECT_EQ(found.count, expected.count);
  EXPECT_EQ(found.mean, expected.mean);
  EXPECT_EQ(found.least, expected.least);
  EXPECT_EQ(found.greatest, expected.greatest);
  EXPECT_EQ(found.quantiles, expected.quantiles);
  EXPECT_EQ(sample_ids(own_ids, 100, 7, ranks), sample_ids(ids, 100, 7, alone));
}
