// SPDX-License-Identifier: BSD-3-Clause
#include "granular/sorting/sort_rows.h"

#include "granular/common/shares.h"

#include "../support/sort_checks.h"
#include "../support/thread_ranks.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>

using granular::begin_of_part;
using granular::Block;
using granular::Executor;
using granular::Notices;

TEST(SortRows, one_process)
{
  for (const std::string& arrangement : arrangements())
  {
    for (const std::size_t rows : std::vector<std::size_t>{ 0, 1, 2, 3, 100, 40000 })
    {
      for (const int threads : { 1, 3 })
      {
        const Ids ids = make_ids(arrangement, rows);
        auto [frame, own_ids] = make_frame(ids, 0, rows, threads == 1, threads == 1);
        Notices notices;
        granular::SerialCommunicator alone;
        sort_by_id(frame, own_ids, alone, notices, {}, Executor(threads));
        EXPECT_TRUE(
          bytes_of(frame) == bytes_of(sorted_frame(ids, 0, rows, threads == 1, threads == 1)))
          << arrangement << ' ' << rows;
        EXPECT_TRUE(notices.empty());
      }
    }
  }
}

/// Part i of k is cut out of what one process sorted.
TEST(SortRows, parts_of_one_process)
{
  const Ids ids = make_ids("repeated", 101);
  for (const int parts : { 1, 2, 7, 101, 150 })
  {
    for (int part = 0; part < parts; ++part)
    {
      auto frame = std::move(make_frame(ids, 0, 101).frame);
      Notices notices;
      granular::SerialCommunicator alone;
      sort_by_id(frame, Block(), alone, notices, {});
      const std::int64_t first = begin_of_part(101, part, parts);
      const std::int64_t last = begin_of_part(101, part + 1, parts);
      keep_rows(frame, first, last - first);
      EXPECT_EQ(bytes_of(frame),
        bytes_of(
          sorted_frame(ids, static_cast<std::size_t>(first), static_cast<std::size_t>(last))));
    }
  }
}

TEST(SortRows, begin_of_part)
{
  for (const std::int64_t rows : { 0, 1, 2, 9, 10, 1000 })
  {
    for (const int parts : { 1, 2, 3, 10, 11, 1999 })
    {
      for (int part = 0; part <= parts; ++part)
      {
        EXPECT_EQ(begin_of_part(rows, part, parts), rows * part / parts);
      }
    }
  }
  // worked out with whole numbers of any length
  constexpr std::int64_t most = std::int64_t{ 1 } << 62;
  EXPECT_EQ(begin_of_part(most, 1, 3), 1537228672809129301);
  EXPECT_EQ(begin_of_part(most, 2, 3), 3074457345618258602);
  EXPECT_EQ(begin_of_part(most, 3, 3), most);
  EXPECT_EQ(begin_of_part(most - 1, 2147483645, 2147483647), 4611686014132420605);
  EXPECT_EQ(begin_of_part(most - 1, 2147483646, 2147483647), 4611686016279904254);
  EXPECT_EQ(begin_of_part(most - 1, 2147483647, 2147483647), most - 1);
}

TEST(SortRows, ranks)
{
  for (const int size : { 2, 3, 8 })
  {
    run_ranks(size, check_sort_by_id);
  }
}

TEST(SortRows, ranks_without_ids)
{
  for (const int size : { 1, 2, 3 })
  {
    run_ranks(size, check_without_ids);
  }
}

TEST(SortRows, ranks_with_other_arrays)
{
  run_ranks(3,
    [](granular::Communicator& ranks)
    {
      auto frame = std::move(make_frame(make_ids("reversed", 5), 0, 5).frame);
      if (ranks.rank() == 2)
      {
        frame.arrays.front().info.name = "mol";
      }
      Notices notices;
      EXPECT_THROW(sort_by_id(frame, Block(), ranks, notices, {}), granular::Error);
    });
}
