// SPDX-License-Identifier: BSD-3-Clause
// Sets of ids: against the words that say them, and against sets.
#include "granular/paths/path_frame.h"

#include "../support/error_of.h"
#include "../support/thread_ranks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <string>
#include <vector>

using namespace granular;

namespace
{
using Id = std::int64_t;
using Ids = std::vector<Id>;

constexpr Id lowest = std::numeric_limits<Id>::min();
constexpr Id highest = std::numeric_limits<Id>::max();

/// Those from -3000 to 6000 that a selection holds.
Ids held(const IdSelection& selection)
{
  Ids ids;
  for (Id id = -3000; id <= 6000; ++id)
  {
    if (selection.holds(id))
    {
      ids.push_back(id);
    }
  }
  return ids;
}

std::string error_of(const std::string& text)
{
  return ::error_of([&] { const IdSelection selection(text); });
}
}

TEST(IdSelection, NothingSaidIsAll)
{
  for (const char* text : { "", "  ", ",", " , ,", "\t" })
  {
    const IdSelection selection(text);
    EXPECT_TRUE(selection.is_all()) << text;
    EXPECT_EQ(held(selection).size(), 9001U);
    EXPECT_TRUE(selection.holds(lowest) && selection.holds(highest));
  }
  EXPECT_TRUE(IdSelection().is_all());
}

TEST(IdSelection, WordsAndRanges)
{
  EXPECT_EQ(held(IdSelection("5")), (Ids{ 5 }));
  EXPECT_FALSE(IdSelection("5").is_all());
  EXPECT_EQ(held(IdSelection("17, 42,43 17 -2")), (Ids{ -2, 17, 42, 43 }));
  EXPECT_EQ(held(IdSelection("10-13")), (Ids{ 10, 11, 12, 13 }));
  EXPECT_EQ(held(IdSelection("10-20:3")), (Ids{ 10, 13, 16, 19 }));
  EXPECT_EQ(held(IdSelection("10-19:3")), (Ids{ 10, 13, 16, 19 }));
  EXPECT_EQ(held(IdSelection("-5--3")), (Ids{ -5, -4, -3 }));
  EXPECT_EQ(held(IdSelection("-3-2:2")), (Ids{ -3, -1, 1 }));
  EXPECT_EQ(held(IdSelection("7-7")), (Ids{ 7 }));
  EXPECT_EQ(held(IdSelection("7-9:100")), (Ids{ 7 }));
  EXPECT_EQ(held(IdSelection("0007")), (Ids{ 7 }));
  EXPECT_EQ(held(IdSelection("5999-20000")), (Ids{ 5999, 6000 }));
}

/// Short ranges and long ones, which are kept otherwise.
TEST(IdSelection, RangesOfAllLengths)
{
  std::mt19937_64 random(3);
  for (int trial = 0; trial < 400; ++trial)
  {
    std::set<Id> expected;
    std::string text;
    for (int i = 0; i < 1 + trial % 4; ++i)
    {
      const Id first = static_cast<Id>(random() % 8000) - 4000;
      const Id last = first + static_cast<Id>(random() % (trial % 2 == 0 ? 50 : 12000));
      const Id step = trial % 3 == 0 ? 1 : 1 + static_cast<Id>(random() % 9);
      text += (i > 0 ? "," : "") + std::to_string(first) + "-" + std::to_string(last) +
        (step > 1 ? ":" + std::to_string(step) : "");
      for (Id id = first; id <= last; id += step)
      {
        expected.insert(id);
      }
    }
    IdSelection selection(text);
    const Id multiple = 1 + trial % 5;
    selection.keep_multiples(multiple);
    std::erase_if(expected, [=](Id id) { return id < -3000 || id > 6000 || id % multiple != 0; });
    ASSERT_EQ(held(selection), Ids(expected.begin(), expected.end())) << text;
  }
}

TEST(IdSelection, BothEndsOfTheIntegers)
{
  const std::string all = "-9223372036854775808-9223372036854775807";
  const IdSelection everything(all);
  const IdSelection odd("-9223372036854775807-9223372036854775807:2");
  const IdSelection four(all + ":4611686018427387904");
  const IdSelection two(all + ":9223372036854775807");
  for (const Id id : { lowest, lowest + 1, Id{ -1 }, Id{ 0 }, Id{ 1 }, highest - 1, highest })
  {
    EXPECT_TRUE(everything.holds(id)) << id;
    EXPECT_EQ(odd.holds(id), id % 2 != 0) << id;
    EXPECT_EQ(four.holds(id), id == lowest || id == 0) << id;
    EXPECT_EQ(two.holds(id), id == lowest || id == -1 || id == highest - 1) << id;
  }
  EXPECT_TRUE(four.holds(lowest / 2) && four.holds(highest / 2 + 1));
  const IdSelection ends("-9223372036854775808 9223372036854775807");
  EXPECT_TRUE(ends.holds(lowest) && ends.holds(highest) && !ends.holds(0));
  IdSelection multiples;
  multiples.keep_multiples(highest);
  EXPECT_TRUE(multiples.holds(-highest) && multiples.holds(0) && multiples.holds(highest));
  EXPECT_FALSE(multiples.holds(lowest) || multiples.holds(1));
}

TEST(IdSelection, WordsThatAreNone)
{
  for (const char* word : { "x", "5x", "5-", "-", "--5", "+5", "5:2", "5-9:", "5-9:0", "5-9:-1",
         "9-5", "5-9:2:2", "1.0", "1e3", "5-x", "9223372036854775808", "-9223372036854775809",
         "1-9223372036854775808", "5;6", "1..3" })
  {
    EXPECT_EQ(error_of(std::string("3 ") + word + ",7"),
      std::string("expected ids like 5, ranges like 10-20 or 100-900:50, got '") + word + "'");
  }
}

TEST(IdSelection, KeepsOnlyAList)
{
  IdSelection selection("1-100");
  selection.keep_multiples(10);
  selection.keep_only(Ids{ 5, 10, 200, 30, 30 });
  EXPECT_EQ(held(selection), (Ids{ 10, 30 }));
  selection.keep_only(Ids{ 20, 30 });
  EXPECT_EQ(held(selection), (Ids{ 30 }));
  IdSelection none;
  none.keep_only({});
  EXPECT_FALSE(none.is_all());
  EXPECT_TRUE(held(none).empty());
}

TEST(IdSamples, AreTheSameForAnyOrderAndAnyRanks)
{
  std::mt19937_64 random(9);
  for (const std::size_t count : { 0U, 1U, 7U, 100U, 299U, 300U, 301U, 5000U })
  {
    Ids ids;
    for (Id i = 0; i < 300; ++i)
    {
      ids.push_back(i < 290 ? 3 * i - 100 : i % 2 == 0 ? lowest + i : highest - i);
    }
    SerialCommunicator alone;
    const Ids expected = sample_ids(ids, count, 5, alone);
    EXPECT_EQ(expected.size(), std::min<std::size_t>(count, 300));
    EXPECT_TRUE(std::is_sorted(expected.begin(), expected.end()));
    EXPECT_EQ(std::adjacent_find(expected.begin(), expected.end()), expected.end());
    for (const Id id : expected)
    {
      EXPECT_NE(std::ranges::find(ids, id), ids.end());
    }
    for (const int size : { 1, 2, 3, 5 })
    {
      std::ranges::shuffle(ids, random);
      run_ranks(size,
        [&](Communicator& ranks)
        {
          Ids own; // some on several ranks, some ranks have none
          for (std::size_t i = 0; i < ids.size(); ++i)
          {
            const auto rank = static_cast<std::size_t>(ranks.rank());
            const auto others = static_cast<std::size_t>(std::max(size - 1, 1));
            if (i % others == rank || i % 50 == rank)
            {
              own.push_back(ids[i]);
              own.push_back(ids[i]);
            }
          }
          EXPECT_EQ(sample_ids(own, count, 5, ranks), expected);
          Ids sorted = ids;
          std::ranges::sort(sorted);
          EXPECT_EQ(share_ids(own, ranks), sorted);
        });
    }
  }
}

/// Smaller samples are parts of larger ones; other seeds choose others, all ids alike.
TEST(IdSamples, SpreadOverTheIds)
{
  Ids ids(1000);
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    ids[i] = static_cast<Id>(i);
  }
  SerialCommunicator alone;
  std::vector<int> chosen(ids.size());
  std::set<Ids> different;
  for (Id seed = -500; seed < 500; ++seed)
  {
    const Ids hundred = sample_ids(ids, 100, seed, alone);
    const Ids ten = sample_ids(ids, 10, seed, alone);
    EXPECT_TRUE(std::ranges::includes(hundred, ten));
    different.insert(ten);
    for (const Id id : hundred)
    {
      ++chosen[static_cast<std::size_t>(id)];
    }
  }
  EXPECT_EQ(different.size(), 1000U);
  // 100 of each in the mean, with a standard deviation of 9.5
  EXPECT_GT(*std::ranges::min_element(chosen), 50);
  EXPECT_LT(*std::ranges::max_element(chosen), 150);
}
