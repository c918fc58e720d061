// SPDX-License-Identifier: BSD-3-Clause
// Run by mpirun.
#include "granular/mpi/mpi_communicator.h"

#include "ring_checks.h"

#include <gtest/gtest.h>

TEST(Ring, every_bit_comes_home)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD);
  ring_checks::check_ring(ranks);
}

/// Buffers that are cut by the ends of messages.
TEST(Ring, small_messages)
{
  granular::MpiCommunicator ranks(MPI_COMM_WORLD, 1001);
  ring_checks::check_ring(ranks);
}
