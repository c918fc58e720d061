// SPDX-License-Identifier: BSD-3-Clause
// Lines of two frames compared: as counting them in a std::map finds.
#include "../support/thread_ranks.h"
#include "compare_checks.h"

using namespace granular;
using namespace compare_checks;

TEST(CompareLines, AnyLinesAnywhere)
{
  SerialCommunicator alone;
  check_lines(alone);
  for (const int ranks : { 1, 2, 3, 5 })
  {
    SCOPED_TRACE(ranks);
    run_ranks(ranks, check_lines);
  }
}

/// Of three bonds between the same two, one breaks: the last of them, by rank and row.
TEST(CompareLines, OfSeveralTheLastOnesAreLost)
{
  for (const int size : { 1, 3 })
  {
    run_ranks(size,
      [&](Communicator& ranks)
      {
        const bool last = ranks.rank() == size - 1;
        const Columns now(last ? std::vector<Line>{ { 8, 9 }, { 9, 8 } } : std::vector<Line>());
        const Columns before(ranks.rank() == 0
            ? std::vector<Line>{ { 8, 9 }, { 1, 2 }, { 8, 9 }, { 9, 8 } }
            : std::vector<Line>());
        const LineChanges found = compare_lines(now.ends(), before.ends(), ranks);
        EXPECT_EQ(found.current, std::vector(last ? 2 : 0, Change::Kept));
        if (ranks.rank() == 0)
        {
          EXPECT_EQ(found.reference,
            (std::vector{ Change::Kept, Change::Lost, Change::Kept, Change::Lost }));
        }
      });
  }
}

TEST(CompareLines, ListsOfOtherSizesAreRefused)
{
  run_ranks(2,
    [](Communicator& ranks)
    {
      const Ids one = { 1 };
      const Ids two = { 1, 2 };
      const bool bad = ranks.rank() == 1;
      EXPECT_THROW(
        compare_lines({ one, bad ? std::span<const Id>(two) : one }, { one, one }, ranks), Error);
      EXPECT_THROW(
        compare_lines({ one, one }, { one, bad ? std::span<const Id>(two) : one }, ranks), Error);
    });
}
