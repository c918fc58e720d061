// SPDX-License-Identifier: BSD-3-Clause
#include "granular/parallel/communicator.h"

#include "../support/communicator_checks.h"
#include "../support/error_of.h"
#include "../support/small_disk.h"
#include "../support/thread_ranks.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <string>

TEST(Communicator, one_process)
{
  granular::SerialCommunicator alone;
  EXPECT_EQ(alone.rank(), 0);
  EXPECT_EQ(alone.size(), 1);
  EXPECT_EQ(alone.node_size(), 1);
  check_broadcast(alone);
  check_all_gather(alone);
  check_sum(alone);
  check_exchange(alone);
  check_send(alone);
}

TEST(Communicator, one_process_throws_what_it_has)
{
  granular::SerialCommunicator alone;
  EXPECT_NO_THROW(granular::agree(alone, nullptr));
  EXPECT_NO_THROW(granular::do_together(alone, [] {}));
  try
  {
    granular::do_together(alone, [] { throw std::out_of_range("as it is"); });
    FAIL();
  }
  catch (const std::out_of_range& error)
  {
    EXPECT_STREQ(error.what(), "as it is");
  }
}

/// Holds that the ranks of the other tests are ranks.
TEST(Communicator, threads)
{
  for (const int size : { 1, 2, 5 })
  {
    run_ranks(size,
      [](granular::Communicator& ranks)
      {
        check_broadcast(ranks);
        check_all_gather(ranks);
        check_sum(ranks);
        check_exchange(ranks);
        check_send(ranks);
        check_send_without_memory(ranks);
      });
  }
}

TEST(Communicator, one_process_opens_a_file)
{
  granular::SerialCommunicator alone;
  const std::string folder = std::string(GRANULAR_OUTPUT) + "/serial";
  check_open_together(alone, folder);
  check_open_together_fails(alone, folder);
  if (!check_full_disk(alone, folder))
  {
    GTEST_SKIP() << SmallDisk::not_there;
  }
}

TEST(Communicator, threads_open_a_file)
{
  std::atomic<bool> full_disk = true;
  for (const int size : { 1, 2, 3 })
  {
    run_ranks(size,
      [&](granular::Communicator& ranks)
      {
        const std::string folder = std::string(GRANULAR_OUTPUT) + "/threads";
        check_open_together(ranks, folder);
        check_open_together_fails(ranks, folder);
        full_disk = check_full_disk(ranks, folder);
      });
  }
  if (!full_disk)
  {
    GTEST_SKIP() << SmallDisk::not_there;
  }
}

TEST(Communicator, agree)
{
  for (const int size : { 2, 3, 9 })
  {
    run_ranks(size, check_agree);
  }
}

TEST(Communicator, work_that_fails_on_one_rank_ends_on_all)
{
  run_ranks(3,
    [](granular::Communicator& ranks)
    {
      const auto work = [&]
      {
        if (ranks.rank() == 1)
        {
          throw granular::FormatError("expected a number, got 'y'");
        }
      };
      EXPECT_EQ(error_of<granular::FormatError>([&] { granular::do_together(ranks, work); }),
        "expected a number, got 'y' (on rank 1 of 3)");
    });
}
