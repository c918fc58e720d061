// SPDX-License-Identifier: BSD-3-Clause
// Tests under mpirun: every rank runs every test, and all fail if one does.
#ifndef granular_tests_support_rank_tests_h
#define granular_tests_support_rank_tests_h

#include <gtest/gtest.h>

#include <mpi.h>

#include <iostream>

/// What passes is told by the first rank, what fails by any.
inline int run_tests_on_ranks(int* argc, char** argv)
{
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
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  ::testing::InitGoogleTest(argc, argv);
  if (rank > 0)
  {
    auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new Failures);
  }
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return failed;
}

#endif
