// SPDX-License-Identifier: BSD-3-Clause
// Ranks without MPI: threads of this process that pass each other their data.
#ifndef granular_tests_base_thread_ranks_h
#define granular_tests_base_thread_ranks_h

#include "granular/base/communicator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <barrier>
#include <cstdint>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

/// What the ranks show to each other between two barriers.
struct Meeting
{
  struct Shown
  {
    std::string bytes;
    std::vector<std::int64_t> counts;
    const char* data = nullptr;
  };

  explicit Meeting(int size)
    : shown(static_cast<std::size_t>(size))
    , barrier(size)
  {
  }

  std::vector<Shown> shown;
  std::barrier<> barrier;
};

class ThreadCommunicator final : public granular::Communicator
{
public:
  ThreadCommunicator(Meeting& meeting, int rank)
    : meeting_(meeting)
    , rank_(rank)
  {
  }

  int rank() const noexcept override { return rank_; }
  int size() const noexcept override { return static_cast<int>(meeting_.shown.size()); }
  int node_size() const noexcept override { return this->size(); }

  void broadcast(std::string& bytes, int root) override
  {
    bytes = this->all_gather(bytes)[static_cast<std::size_t>(root)];
  }

  std::vector<std::string> all_gather(std::string_view bytes) override
  {
    std::vector<std::string> all;
    this->meet(
      { std::string(bytes), {} }, [&](const Meeting::Shown& other) { all.push_back(other.bytes); });
    return all;
  }

  void sum(std::span<std::int64_t> values) override
  {
    std::vector<std::int64_t> total(values.size());
    this->meet({ {}, { values.begin(), values.end() } },
      [&](const Meeting::Shown& other)
      {
        std::transform(
          total.begin(), total.end(), other.counts.begin(), total.begin(), std::plus<>());
      });
    std::copy(total.begin(), total.end(), values.begin());
  }

  void exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
    std::span<const std::int64_t> to_bytes) override
  {
    this->meet({ {}, { from_bytes.begin(), from_bytes.end() }, from },
      [&, source = std::size_t{ 0 }](const Meeting::Shown& other) mutable
      {
        const auto begin = other.counts.begin();
        to = std::copy_n(other.data + std::accumulate(begin, begin + rank_, std::int64_t{ 0 }),
          other.counts[static_cast<std::size_t>(rank_)], to);
        matched_ = matched_ && other.counts[static_cast<std::size_t>(rank_)] == to_bytes[source++];
      });
  }

  /// Whether all exchanges said what was sent.
  bool matched() const noexcept { return matched_; }

private:
  void meet(Meeting::Shown own, std::function<void(const Meeting::Shown&)> look)
  {
    meeting_.shown[static_cast<std::size_t>(rank_)] = std::move(own);
    meeting_.barrier.arrive_and_wait();
    std::for_each(meeting_.shown.begin(), meeting_.shown.end(), std::ref(look));
    meeting_.barrier.arrive_and_wait();
  }

  Meeting& meeting_;
  int rank_;
  bool matched_ = true;
};

/// Runs work on each of `size` ranks.
inline void run_ranks(int size, const std::function<void(granular::Communicator& ranks)>& work)
{
  Meeting meeting(size);
  std::vector<std::jthread> threads;
  for (int rank = 0; rank < size; ++rank)
  {
    threads.emplace_back(
      [&, rank]
      {
        ThreadCommunicator ranks(meeting, rank);
        work(ranks);
        EXPECT_TRUE(ranks.matched());
      });
  }
}

#endif
