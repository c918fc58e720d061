// SPDX-License-Identifier: BSD-3-Clause
// Ranks without MPI: threads of this process that pass each other their data.
#ifndef granular_tests_support_thread_ranks_h
#define granular_tests_support_thread_ranks_h

#include "granular/bytes/byte_sink.h"
#include "granular/parallel/communicator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

/// From one rank to another, who takes it from hand to hand: a sender always waits.
class Handover
{
public:
  void give(std::string_view bytes)
  {
    std::unique_lock lock(mutex_);
    offered_ = &bytes;
    changed_.notify_all();
    changed_.wait(lock, [&] { return !offered_; });
  }

  std::string take()
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return offered_ != nullptr; });
    const std::string_view offered = *std::exchange(offered_, nullptr);
    changed_.notify_all(); // who waits goes on when this is left, also without memory
    return std::string(offered);
  }

private:
  std::mutex mutex_;
  std::condition_variable changed_;
  const std::string_view* offered_ = nullptr;
};

/// As std::barrier, but who waits sleeps at once: there may be many more ranks than cores.
class Barrier
{
public:
  explicit Barrier(int size)
    : size_(size)
  {
  }

  void arrive_and_wait()
  {
    std::unique_lock lock(mutex_);
    if (++arrived_ == size_)
    {
      arrived_ = 0;
      ++round_;
      all_here_.notify_all();
      return;
    }
    all_here_.wait(lock, [this, round = round_] { return round_ != round; });
  }

private:
  std::mutex mutex_;
  std::condition_variable all_here_;
  const int size_;
  int arrived_ = 0;
  std::uint64_t round_ = 0;
};

/// What the ranks show to each other between two barriers, and what they give to each other.
struct Meeting
{
  struct Shown
  {
    std::vector<std::int64_t> counts;
    const char* data = nullptr;
  };

  explicit Meeting(int size)
    : shown(static_cast<std::size_t>(size))
    , handovers(shown.size() * shown.size())
    , barrier(size)
  {
  }

  Handover& handover(int from, int to)
  {
    return handovers[static_cast<std::size_t>(from) * shown.size() + static_cast<std::size_t>(to)];
  }

  std::vector<Shown> shown;
  std::vector<Handover> handovers;
  std::shared_ptr<granular::NewFile> file; ///< being opened
  Barrier barrier;
};

/// One file that all ranks have.
class ThreadFile final : public granular::OutputFile
{
public:
  ThreadFile(granular::Communicator& ranks, std::shared_ptr<granular::NewFile> file)
    : ranks_(ranks)
    , file_(std::move(file))
  {
  }

  ~ThreadFile() override
  {
    file_.reset();
    granular::agree(ranks_, nullptr); // nothing is left of it when the first rank goes on
  }

  void write_at(std::int64_t offset, std::string_view bytes) override
  {
    file_->write_at(offset, bytes);
  }

  void finish(bool durable) override
  {
    granular::agree(ranks_, nullptr); // all have written
    granular::do_together(ranks_,
      [&]
      {
        if (ranks_.rank() == 0)
        {
          file_->finish(durable);
        }
      });
  }

private:
  granular::Communicator& ranks_;
  std::shared_ptr<granular::NewFile> file_;
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

  void send(std::string_view bytes, int to) override
  {
    this->expect_other(to);
    meeting_.handover(rank_, to).give(bytes);
  }

  void receive(std::string& bytes, int from) override
  {
    this->expect_other(from);
    bytes = meeting_.handover(from, rank_).take();
    if (!bytes.empty() && --kept_ == -1)
    {
      throw std::bad_alloc();
    }
  }

  /// Makes receive lack memory for one message, after so many others.
  void lack_memory_after(int messages) noexcept { kept_ = messages; }

  std::unique_ptr<granular::OutputFile> open_together(const std::string& path) override
  {
    granular::do_together(*this,
      [&]
      {
        if (rank_ == 0)
        {
          meeting_.file = std::make_shared<granular::NewFile>(path);
        }
      });
    auto file = std::make_unique<ThreadFile>(*this, meeting_.file);
    meeting_.barrier.arrive_and_wait();
    if (rank_ == 0)
    {
      meeting_.file.reset();
    }
    return file;
  }

  /// Whether all exchanges said what was sent.
  bool matched() const noexcept { return matched_; }

  /// Bytes that were broadcast.
  std::size_t broadcast_bytes() const noexcept { return broadcast_bytes_; }

private:
  void do_broadcast(std::span<char> bytes, int root) override
  {
    broadcast_bytes_ += bytes.size();
    this->show({ {}, bytes.data() },
      [&, rank = 0](const Meeting::Shown& other) mutable
      {
        if (rank++ == root && root != rank_)
        {
          std::copy_n(other.data, bytes.size(), bytes.data());
        }
      });
  }

  void do_gather(char* parts, std::span<const std::int64_t> counts) override
  {
    this->show({ {}, parts },
      [&, rank = 0, begin = std::int64_t{ 0 }](const Meeting::Shown& other) mutable
      {
        const std::int64_t count = counts[static_cast<std::size_t>(rank)];
        if (rank++ != rank_)
        {
          std::copy_n(other.data + begin, count, parts + begin);
        }
        begin += count;
      });
  }

  void do_sum(std::span<std::int64_t> values) override
  {
    std::vector<std::int64_t> total(values.size());
    this->show({ { values.begin(), values.end() } },
      [&](const Meeting::Shown& other)
      {
        std::transform(
          total.begin(), total.end(), other.counts.begin(), total.begin(), std::plus<>());
      });
    std::copy(total.begin(), total.end(), values.begin());
  }

  void do_exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
    std::span<const std::int64_t> to_bytes) override
  {
    this->show({ { from_bytes.begin(), from_bytes.end() }, from },
      [&, source = std::size_t{ 0 }](const Meeting::Shown& other) mutable
      {
        const auto begin = other.counts.begin();
        to = std::copy_n(other.data + std::accumulate(begin, begin + rank_, std::int64_t{ 0 }),
          other.counts[static_cast<std::size_t>(rank_)], to);
        matched_ = matched_ && other.counts[static_cast<std::size_t>(rank_)] == to_bytes[source++];
      });
  }

  void expect_other(int rank) const
  {
    if (rank == rank_)
    {
      throw std::logic_error("expected another rank, got this one");
    }
  }

  void show(Meeting::Shown own, std::function<void(const Meeting::Shown&)> look)
  {
    meeting_.shown[static_cast<std::size_t>(rank_)] = std::move(own);
    meeting_.barrier.arrive_and_wait();
    std::for_each(meeting_.shown.begin(), meeting_.shown.end(), std::ref(look));
    meeting_.barrier.arrive_and_wait();
  }

  Meeting& meeting_;
  int rank_;
  bool matched_ = true;
  int kept_ = std::numeric_limits<int>::max();
  std::size_t broadcast_bytes_ = 0;
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
