// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun.
#include "granular/mpi/mpi_communicator.h"

#include "gathered_bounds.h"

#include <gtest/gtest.h>

TEST(GatherBounds, mpi)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD);
  check_gathered(ranks);
  check_gathered(ranks); // nothing of the first time is left
}
