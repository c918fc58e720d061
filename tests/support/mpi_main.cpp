// SPDX-License-Identifier: BSD-3-Clause
// main() of a test program of the core under mpirun.
#include "rank_tests.h"

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  const int failed = run_tests_on_ranks(&argc, argv);
  MPI_Finalize();
  return failed;
}
