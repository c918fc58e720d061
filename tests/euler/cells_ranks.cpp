// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun.
#include "granular/mpi/mpi_communicator.h"

#include "gathered_cells.h"

#include <gtest/gtest.h>

TEST(GatherCells, mpi)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD);
  check_gathered_buffers(ranks);
  check_gathered_cells(ranks);
  check_counts(ranks);
  check_gathered_cells(ranks); // nothing of the first time is left
}
