// SPDX-License-Identifier: BSD-3-Clause
// main() of a test program under mpirun: every rank runs every test, and all fail if one does.
#include <gtest/gtest.h>

#include <mpi.h>

#include <iostream>

int main(int argc, char** argv)
{
  MPI_Init(&argc, &argv);
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  ::testing::InitGoogleTest(&argc, argv);
  if (rank > 0) // what fails is told by any rank, what passes by the first
  {
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    struct Failures : ::testing::EmptyTestEventListener
    {
      void OnTestPartResult(const ::testing::TestPartResult& result) override
      {
        if (result.failed())
        {
          std::cout << result << std::endl;
        }
      }
    };
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new Failures);
  }
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed;
}
