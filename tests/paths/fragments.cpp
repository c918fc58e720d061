// SPDX-License-Identifier: BSD-3-Clause
// Fragments: what a search from particle to particle finds, with masses that are sums of integers.
#include "../support/error_of.h"
#include "../support/thread_ranks.h"
#include "compare_checks.h"

#include <atomic>

using namespace granular;
using namespace compare_checks;

namespace
{
constexpr double none = std::numeric_limits<double>::quiet_NaN();

Fragments find_alone(
  const Ids& ids, const std::vector<double>& masses, const Ids& id1, const Ids& id2)
{
  SerialCommunicator alone;
  return find_fragments(ids, masses, id1, id2, alone);
}
}

TEST(Fragments, AnyNetsAnywhere)
{
  SerialCommunicator alone;
  check_fragments(alone);
  for (const int ranks : { 1, 2, 3, 4, 7 })
  {
    SCOPED_TRACE(ranks);
    run_ranks(ranks, check_fragments);
  }
}

TEST(Fragments, ALongChainInRandomOrder)
{
  HardCase hard("fragments",
    "chain of 10^5 bonds in random order on 1 to 5 ranks, masses over 100 binary orders: mass not "
    "correctly rounded",
    "particles", 0);
  const Net chain = make_chain(100'000);
  const auto expected = expected_fragments(chain);
  for (const int size : { 1, 2, 5 })
  {
    std::atomic<std::int64_t> wrong = 0;
    run_ranks(size,
      [&](Communicator& ranks)
      { wrong += check_net(ranks, chain, expected, all_places()[0], all_places()[3]); });
    hard.add(static_cast<double>(wrong), std::ssize(chain.ids));
  }
}

TEST(Fragments, SmallMassesDecideTheRounding)
{
  const Ids ids = { 1, 2, 3, 4 };
  const Ids id1 = { 1, 2 };
  const Ids id2 = { 2, 3 };
  // half an ulp of 1, and a bit more; the fourth is alone
  const auto half = find_alone(ids, { 1, 0x1p-53, 0x1p-900, 5 }, id1, id2);
  EXPECT_EQ(half.masses, (std::vector{ 1 + 0x1p-52, 1 + 0x1p-52, 1 + 0x1p-52, 5. }));
  const auto even = find_alone(ids, { 0x1p-53, 1, 0, 0 }, id1, id2);
  EXPECT_EQ(even.masses, (std::vector{ 1., 1., 1., 0. }));
  const auto cancels = find_alone(ids, { 0x1p899, 0x1p-1074, -0x1p899, -1 }, id1, id2);
  EXPECT_EQ(cancels.masses, (std::vector{ 0x1p-1074, 0x1p-1074, 0x1p-1074, -1. }));
}

TEST(Fragments, MassesThatCannotBeAddedAreNone)
{
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : { none, infinity, -infinity, 1e300 })
  {
    const auto found = find_alone({ 1, 2, 3, 4, 5 }, { 1, bad, 2, 3, bad }, { 1, 3 }, { 2, 4 });
    EXPECT_TRUE(std::isnan(found.masses[0]));
    EXPECT_TRUE(std::isnan(found.masses[1]));
    EXPECT_EQ(found.masses[2], 5);
    EXPECT_EQ(found.masses[3], 5);
    EXPECT_TRUE(std::isnan(found.masses[4]));
    EXPECT_EQ(found.labels, (Ids{ 1, 1, 3, 3, 5 }));
  }
}

TEST(Fragments, RepeatedIdsAreRefusedWithTheirRows)
{
  const std::string expected =
    "expected each id once among the particles, got id -4 in rows 1 and 4 (the first is 0)";
  const Ids all = { 9, -4, 3, 9 - (Id{ 1 } << 40), -4, 3 };
  EXPECT_EQ(error_of([&] { find_alone(all, std::vector<double>(6), {}, {}); }), expected);
  for (const int size : { 2, 3 })
  {
    run_ranks(size,
      [&](Communicator& ranks)
      {
        // consecutive rows on each rank, so that rows over all ranks are those of the list
        const auto rank = static_cast<std::size_t>(ranks.rank());
        const auto ranges = static_cast<std::size_t>(size);
        const Ids own(all.begin() + static_cast<std::ptrdiff_t>(6 * rank / ranges),
          all.begin() + static_cast<std::ptrdiff_t>(6 * (rank + 1) / ranges));
        EXPECT_EQ(error_of([&] { find_fragments(own, {}, {}, {}, ranks); }), expected);
      });
  }
}

TEST(Fragments, ListsOfOtherSizesAreRefused)
{
  EXPECT_NE(error_of([] { find_alone({ 1 }, { 1, 2 }, {}, {}); }), "");
  EXPECT_NE(error_of([] { find_alone({ 1 }, { 1 }, { 1 }, {}); }), "");
}
