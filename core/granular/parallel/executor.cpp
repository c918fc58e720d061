// SPDX-License-Identifier: BSD-3-Clause
#include "granular/parallel/executor.h"

#include "granular/common/error.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

namespace granular
{
namespace
{
/// State that the workers of one parallel_for share.
struct Work
{
  std::size_t chunks;
  const std::function<void(std::size_t, std::size_t)>& task;
  std::atomic<std::size_t> next = 0; ///< chunk to be begun
  std::mutex mutex{};
  std::size_t failed = std::numeric_limits<std::size_t>::max(); ///< the first chunk that threw
  std::exception_ptr exception{};

  bool run_next(std::size_t worker)
  {
    const std::size_t chunk = next.fetch_add(1);
    if (chunk >= chunks)
    {
      return false;
    }
    try
    {
      task(chunk, worker);
    }
    catch (...)
    {
      this->fail(chunk, caught_exception());
    }
    return true;
  }

  void fail(std::size_t chunk, std::exception_ptr thrown)
  {
    next = chunks;
    const std::lock_guard lock(mutex);
    if (chunk < failed)
    {
      failed = chunk;
      exception = std::move(thrown);
    }
  }
};
}

Executor::Executor(int threads) noexcept
  : threads_(std::max(1, threads))
{
}

std::size_t Executor::workers(std::size_t chunks) const noexcept
{
  return std::clamp(chunks, std::size_t{ 1 }, static_cast<std::size_t>(threads_));
}

void Executor::parallel_for(std::size_t chunks,
  const std::function<void(std::size_t chunk, std::size_t worker)>& task, Progress& progress) const
{
  Work work{ chunks, task };
  bool cancelled = false;
  {
    std::vector<std::jthread> threads; // joined at the end of the block
    try
    {
      threads.reserve(this->workers(chunks) - 1);
      for (std::size_t worker = 1; worker < this->workers(chunks); ++worker)
      {
        threads.emplace_back(
          [&work, worker]
          {
            while (work.run_next(worker))
            {
            }
          });
      }
    }
    catch (const std::exception&)
    {
      // the system gives no more threads, or no memory for them: those that there are do it
    }
    try
    {
      do
      {
        progress.step(static_cast<double>(std::min(work.next.load(), chunks)) /
          static_cast<double>(std::max<std::size_t>(chunks, 1)));
      } while (work.run_next(0));
    }
    catch (const Cancelled&)
    {
      cancelled = true;
      work.next = chunks;
    }
    catch (...)
    {
      // of the progress itself: it must not pass by threads that use what the caller owns
      work.next = chunks;
      work.fail(0, caught_exception());
    }
  }
  if (work.exception)
  {
    std::rethrow_exception(work.exception);
  }
  if (cancelled)
  {
    throw Cancelled{};
  }
}

void Executor::for_each_stretch(std::size_t things, std::size_t stretch,
  const std::function<void(std::size_t first, std::size_t count, std::size_t worker)>& task,
  Progress& progress) const
{
  this->parallel_for((things + stretch - 1) / stretch,
    [&](std::size_t chunk, std::size_t worker)
    {
      const std::size_t first = chunk * stretch;
      task(first, std::min(stretch, things - first), worker);
    },
    progress);
}
}
