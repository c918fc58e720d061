// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun.
#include "granular/mpi/mpi_communicator.h"

#include "compare_checks.h"

TEST(CompareRanks, lines_and_fragments)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD);
  compare_checks::check_lines(ranks);
  compare_checks::check_fragments(ranks);
}

/// Values that are cut by the ends of messages.
TEST(CompareRanks, small_messages)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD, 1001);
  compare_checks::check_lines(ranks);
  compare_checks::check_fragments(ranks);
}
