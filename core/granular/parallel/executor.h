// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_parallel_executor_h
#define granular_parallel_executor_h

#include "granular/common/progress.h"

#include <atomic>
#include <cstddef>
#include <functional>

namespace granular
{
/// Returns the cores of the machine, at least 1.
int machine_cores() noexcept;

/// Returns the cores that this process may use, at least 1.
int available_cores() noexcept;

/// Runs chunks of work on threads of its own.
class Executor
{
public:
  /// threads: at least 1, including the caller's.
  explicit Executor(int threads = 1) noexcept;

  int threads() const noexcept { return threads_; }

  /// Returns the number of workers that parallel_for has for a number of chunks, at least 1.
  std::size_t workers(std::size_t chunks) const noexcept;

  /// Calls task(chunk, worker) for each chunk from 0 to chunks - 1, with worker < workers(chunks). Chunks begin in order, and
  /// each worker does one at a time. Worker 0 is the caller, which also reports progress before each of its chunks. All work
  /// has ended on return or throw. After a chunk throws, no other begins; the exception of the lowest chunk comes out, for
  /// any number of threads. Throws Cancelled if progress asks for it.
  void parallel_for(std::size_t chunks,
    const std::function<void(std::size_t chunk, std::size_t worker)>& task,
    Progress& progress) const;

  /// Calls task(first, count, worker) for stretches of `stretch` of so many things, of which the last may be shorter.
  /// Otherwise as parallel_for.
  void for_each_stretch(std::size_t things, std::size_t stretch,
    const std::function<void(std::size_t first, std::size_t count, std::size_t worker)>& task,
    Progress& progress) const;

private:
  int threads_;
};

/// Lets the chunks of a parallel_for pass a gate one after the other, in order. Every chunk must pass, even after an error;
/// Turn ensures that.
class Turns
{
public:
  void wait(std::size_t chunk) const noexcept; ///< until all chunks before have passed
  void pass(std::size_t chunk) noexcept;       ///< lets the next one pass
  void restart() noexcept { next_ = 0; }       ///< when nobody waits

private:
  std::atomic<std::size_t> next_ = 0;
};

/// The turn of one chunk: passes when it is done, or when it goes out of scope without.
class Turn
{
public:
  Turn(Turns& turns, std::size_t chunk) noexcept
    : turns_(turns)
    , chunk_(chunk)
  {
  }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;
  ~Turn() { this->pass(); }

  void wait() const noexcept { turns_.wait(chunk_); }

  void pass() noexcept
  {
    if (!passed_)
    {
      turns_.wait(chunk_);
      turns_.pass(chunk_);
      passed_ = true;
    }
  }

private:
  Turns& turns_;
  std::size_t chunk_;
  bool passed_ = false;
};
}
#endif
