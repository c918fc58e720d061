// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun.
#include "granular/mpi/mpi_communicator.h"

#include "../support/sort_checks.h"

#include <gtest/gtest.h>

TEST(SortRowsRanks, sort)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD);
  check_sort_by_id(ranks);
}

/// Rows that are cut by the ends of messages.
TEST(SortRowsRanks, small_messages)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD, 1001);
  check_sort_by_id(ranks);
}

TEST(SortRowsRanks, without_ids)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD);
  check_without_ids(ranks);
}
