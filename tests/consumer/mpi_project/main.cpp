// SPDX-License-Identifier: BSD-3-Clause
// A program outside the project: counts its ranks, here one.
#include "granular/mpi/mpi_communicator.h"

#include <cstdint>

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  std::int64_t count[] = { 1 };
  {
    granular::MpiCommunicator ranks(MPI_COMM_WORLD);
    ranks.sum(count);
  }
  MPI_Finalize();
  return count[0] == 1 ? 0 : 1;
}
