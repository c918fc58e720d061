// SPDX-License-Identifier: BSD-3-Clause
#include "granular/parallel/executor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace
{
using granular::Cancelled;
using granular::Executor;
using granular::Progress;
using granular::Turn;
using granular::Turns;

/// Stops, or throws, at a report.
class Watch final : public Progress
{
public:
  explicit Watch(int stop_at = -1, int throw_at = -1)
    : stop_at_(stop_at)
    , throw_at_(throw_at)
  {
  }

  bool report(double fraction) override
  {
    EXPECT_EQ(std::this_thread::get_id(), caller_);
    fractions.push_back(fraction);
    const int now = static_cast<int>(fractions.size()) - 1;
    if (now == throw_at_)
    {
      throw std::logic_error("of the progress");
    }
    return now != stop_at_;
  }

  std::vector<double> fractions;

private:
  int stop_at_;
  int throw_at_;
  std::thread::id caller_ = std::this_thread::get_id();
};

/// What comes out of a parallel_for: the text of an exception, "cancelled" or "".
std::string outcome(int threads, std::size_t chunks,
  const std::function<void(std::size_t, std::size_t)>& task, Progress& progress)
{
  try
  {
    Executor(threads).parallel_for(chunks, task, progress);
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
  catch (const Cancelled&)
  {
    return "cancelled";
  }
  return "";
}
}

TEST(Executor, EveryChunkOnceByOneWorkerAtATime)
{
  for (const int threads : { -1, 1, 2, 3, 8, 40 })
  {
    for (const std::size_t chunks : { 0u, 1u, 2u, 7u, 500u })
    {
      const Executor executor(threads);
      const std::size_t workers = executor.workers(chunks);
      EXPECT_EQ(workers,
        std::max<std::size_t>(1, std::min(chunks, static_cast<std::size_t>(executor.threads()))));
      std::vector<std::atomic<int>> done(chunks);
      std::vector<std::atomic<int>> busy(workers);
      std::vector<std::size_t> last(workers, 0);
      const std::thread::id caller = std::this_thread::get_id();
      Watch progress;
      executor.parallel_for(
        chunks,
        [&](std::size_t chunk, std::size_t worker)
        {
          ASSERT_LT(worker, workers);
          EXPECT_EQ(worker == 0, std::this_thread::get_id() == caller);
          EXPECT_EQ(busy[worker].fetch_add(1), 0);
          EXPECT_LE(last[worker], chunk); // begun in their order
          last[worker] = chunk;
          ++done[chunk];
          --busy[worker];
        },
        progress);
      EXPECT_TRUE(std::ranges::all_of(done, [](const auto& times) { return times == 1; }));
      ASSERT_FALSE(progress.fractions.empty());
      EXPECT_TRUE(std::ranges::is_sorted(progress.fractions));
      EXPECT_GE(progress.fractions.front(), 0);
      EXPECT_LE(progress.fractions.back(), 1);
      EXPECT_TRUE(threads > 1 || chunks == 0 || progress.fractions.back() == 1);
    }
  }
}

/// When a chunk begins, all before it have begun.
TEST(Executor, ChunksBeginInTheirOrder)
{
  std::vector<std::atomic<bool>> begun(300);
  std::mutex mutex;
  std::size_t next = 0;
  Watch progress;
  Turns turns;
  Executor(4).parallel_for(
    begun.size(),
    [&](std::size_t chunk, std::size_t)
    {
      begun[chunk] = true;
      Turn turn(turns, chunk); // a chunk that waited for one that had not begun would wait for ever
      turn.wait();
      const std::lock_guard lock(mutex);
      EXPECT_EQ(next++, chunk);
      EXPECT_TRUE(std::all_of(begun.begin(), begun.begin() + static_cast<std::ptrdiff_t>(chunk),
        [](const auto& one) { return one.load(); }));
    },
    progress);
  EXPECT_EQ(next, begun.size());
}

TEST(Executor, TheFirstExceptionByNumber)
{
  for (int repeat = 0; repeat < 20; ++repeat)
  {
    for (const int threads : { 1, 2, 3, 5, 9 })
    {
      for (const std::size_t first : { 0u, 1u, 5u, 38u, 39u })
      {
        Watch progress;
        std::atomic<std::size_t> ended = 0;
        std::atomic<std::size_t> begun = 0;
        EXPECT_EQ(outcome(
                    threads, 40,
                    [&](std::size_t chunk, std::size_t)
                    {
                      ++begun;
                      if (chunk == first)
                      {
                        std::this_thread::yield(); // those behind are likely to throw before
                      }
                      ++ended;
                      if (chunk >= first)
                      {
                        throw std::runtime_error(std::to_string(chunk));
                      }
                    },
                    progress),
          std::to_string(first));
        EXPECT_EQ(begun, ended);
        EXPECT_GT(begun, first);
      }
    }
  }
}

TEST(Executor, StretchesAreTheWhole)
{
  granular::Progress quiet;
  for (const int threads : { 1, 3 })
  {
    for (const std::size_t things : { 0U, 1U, 9U, 10U, 11U, 1000U })
    {
      std::vector<std::atomic<int>> done(things);
      Executor(threads).for_each_stretch(
        things, 10,
        [&](std::size_t first, std::size_t count, std::size_t worker)
        {
          EXPECT_EQ(count, std::min<std::size_t>(10, things - first));
          EXPECT_LT(worker, static_cast<std::size_t>(threads));
          for (std::size_t i = first; i < first + count; ++i)
          {
            ++done[i];
          }
        },
        quiet);
      EXPECT_TRUE(
        std::ranges::all_of(done, [](const std::atomic<int>& times) { return times == 1; }));
    }
  }
}

TEST(Executor, CancelledAtEveryReport)
{
  for (const int threads : { 1, 2, 4 })
  {
    for (int stop = 0; stop < 12; ++stop)
    {
      Watch progress(stop);
      std::atomic<int> done = 0;
      const std::string said = outcome(
        threads, 10, [&](std::size_t, std::size_t) { ++done; }, progress);
      const bool stopped = static_cast<int>(progress.fractions.size()) > stop;
      EXPECT_EQ(said, stopped ? "cancelled" : "");
      EXPECT_TRUE(stopped || done == 10);
      EXPECT_TRUE(threads > 1 || stop > 10 || done == stop);
    }
  }
}

TEST(Executor, WhatTheProgressThrowsComesOut)
{
  for (const int threads : { 1, 2, 4 })
  {
    for (const std::size_t chunks : { 0u, 1u, 10u })
    {
      Watch progress(-1, 0);
      std::atomic<int> done = 0;
      EXPECT_EQ(outcome(
                  threads, chunks, [&](std::size_t, std::size_t) { ++done; }, progress),
        "of the progress");
    }
  }
}

/// Chunks pass three places one after the other; any of them throws anywhere, or several do: all others
/// pass, none twice, and the first comes out.
TEST(Executor, TurnsGoOnWhereverAChunkThrows)
{
  constexpr std::size_t chunks = 12;
  for (const int threads : { 1, 2, 3, 7, 20 })
  {
    for (std::size_t bad = 0; bad < chunks; ++bad)
    {
      for (int place = 1; place < 6; ++place)
      {
        Turns reads;
        Turns places;
        std::size_t read = 0; // these are guarded by the turns alone
        std::size_t placed = 0;
        Watch progress;
        const std::string said = outcome(
          threads, chunks,
          [&](std::size_t chunk, std::size_t)
          {
            const auto at = [&](int now)
            {
              if (now == place && (chunk == bad || chunk == bad + 2))
              {
                throw std::runtime_error(std::to_string(chunk));
              }
            };
            Turn own_place(places, chunk);
            Turn own_read(reads, chunk);
            at(1);
            own_read.wait();
            EXPECT_LE(read, chunk);
            read = chunk;
            at(2);
            own_read.pass();
            own_read.pass(); // once more does nothing
            at(3);
            own_place.wait();
            EXPECT_LE(placed, chunk);
            placed = chunk;
            at(4);
            own_place.pass();
            at(5);
          },
          progress);
        EXPECT_EQ(said, std::to_string(bad));
      }
    }
  }
}

TEST(Executor, ManyTimesWithFewChunks)
{
  std::atomic<std::int64_t> sum = 0;
  Progress progress;
  const Executor executor(3);
  for (int repeat = 0; repeat < 300; ++repeat)
  {
    Turns turns;
    std::size_t next = 0;
    executor.parallel_for(
      4,
      [&](std::size_t chunk, std::size_t)
      {
        Turn turn(turns, chunk);
        turn.wait();
        EXPECT_EQ(next++, chunk);
        turn.pass();
        sum += static_cast<std::int64_t>(chunk);
      },
      progress);
  }
  EXPECT_EQ(sum, 300 * 6);
}

TEST(Executor, TurnsCanBeUsedAgain)
{
  Turns turns;
  for (int round = 0; round < 3; ++round)
  {
    turns.restart();
    for (std::size_t chunk = 0; chunk < 5; ++chunk)
    {
      turns.wait(chunk);
      turns.pass(chunk);
    }
  }
}

TEST(Executor, ThereIsACore)
{
  EXPECT_GE(granular::available_cores(), 1);
  EXPECT_GE(granular::machine_cores(), 1);
}
