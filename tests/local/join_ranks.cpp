// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun.
#include "granular/mpi/mpi_communicator.h"

#include "join_checks.h"

#include <gtest/gtest.h>

TEST(JoinRanks, everywhere)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD);
  join_checks::check_joins(ranks);
  join_checks::check_ghosts(ranks);
  join_checks::check_repeated(ranks);
  join_checks::check_hub(ranks);
}

/// Values that are cut by the ends of messages.
TEST(JoinRanks, small_messages)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD, 1001);
  join_checks::check_joins(ranks);
}
