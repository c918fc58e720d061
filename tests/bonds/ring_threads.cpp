// SPDX-License-Identifier: BSD-3-Clause
// The ring without MPI.
#include "../support/thread_ranks.h"
#include "ring_checks.h"

#include <gtest/gtest.h>

TEST(Ring, one_process)
{
  granular::SerialCommunicator ranks;
  ring_checks::check_ring(ranks);
}

TEST(Ring, threads)
{
  for (const int size : { 1, 2, 3, 5 })
  {
    run_ranks(size, [](granular::Communicator& ranks) { ring_checks::check_ring(ranks); });
  }
}
