// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_parallel_communicator_h
#define granular_parallel_communicator_h

#include "granular/bytes/byte_sink.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace granular
{
/// The ranks that work together. All functions but rank, size, node_size, send and receive are collective: every rank calls
/// them, in the same order. Sizes have 64 bits.
///
/// Each collective begins with an exchange of status. A rank that threw since the last collective brings its exception to
/// that exchange (do_together, agree), and the collective throws the same on all ranks, so no rank waits for one that has
/// left.
class Communicator
{
public:
  virtual ~Communicator() = default;

  virtual int rank() const noexcept = 0;
  virtual int size() const noexcept = 0;

  /// Returns the number of ranks on this machine, including this one.
  virtual int node_size() const noexcept = 0;

  /// Gives all ranks the bytes of the root, from 0 to size() - 1. Throws MemoryError on all ranks if one lacks memory for
  /// them.
  void broadcast(std::string& bytes, int root);

  /// Returns the bytes of every rank, by rank, on all ranks; for small data. Throws MemoryError on all ranks if one lacks
  /// memory for them.
  std::vector<std::string> all_gather(std::string_view bytes);

  /// Adds up each value over the ranks, on all ranks.
  void sum(std::span<std::int64_t> values);

  /// Sends each rank its part of `from`, and stores the received parts, by rank, in `to`. from_bytes and to_bytes hold the
  /// bytes for each rank; to_bytes must match what the others send.
  void exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
    std::span<const std::int64_t> to_bytes);

  /// Only exchanges status: see agree.
  void agree(const std::exception_ptr& failure) { this->meet(failure, {}); }

  /// Tells the other ranks at once that this one has failed, so that they can stop: see called_off. Neither function is
  /// collective. The exchange of status does the same; a rank that cannot reach it yet may call this before. Never throws for
  /// lack of memory.
  virtual void call_off() {}

  /// Returns true if another rank has called off the current work.
  virtual bool called_off() { return false; }

  /// Sends bytes to another rank, which must receive them; messages between two ranks keep their order. May wait until they
  /// are received. Throws std::logic_error, like receive, if the other is this rank, or ranks have no messages. receive throws
  /// std::bad_alloc if memory is lacking for the bytes; the message is then lost, and the next one can be received.
  virtual void send(std::string_view bytes, int to);
  virtual void receive(std::string& bytes, int from);

  /// Returns a file that all ranks write to at their own offsets, each from its main thread, or null if these ranks cannot.
  /// Collective, like its destructor and its finish, before which all ranks know that all have written their part
  /// (do_together). An error on one rank is an error on all, except in write_at.
  virtual std::unique_ptr<OutputFile> open_together(const std::string&) { return {}; }

protected:
  /// Building blocks of the functions above, only for several ranks. No rank has failed when they are called.
  virtual void do_sum(std::span<std::int64_t> values) = 0;
  virtual void do_broadcast(std::span<char> bytes, int root) = 0;
  /// Fills the parts of the other ranks, by rank; counts holds the bytes of each. prepare comes before and allocates memory.
  virtual void prepare_gather(std::span<const std::int64_t>) {}
  virtual void do_gather(char* parts, std::span<const std::int64_t> counts) = 0;
  virtual void prepare_exchange(std::span<const std::int64_t>, std::span<const std::int64_t>) {}
  virtual void do_exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
    std::span<const std::int64_t> to_bytes) = 0;

  /// Completes call_off when all ranks know how many have called off.
  virtual void settle(std::int64_t callers) { static_cast<void>(callers); }

private:
  /// Values that are summed together with the status.
  static constexpr std::size_t most_beside = 15;

  std::int64_t add_up(bool failed, std::span<std::int64_t> beside);
  void meet(const std::exception_ptr& failure, std::span<std::int64_t> beside);
  [[noreturn]] void fail_together(const std::exception_ptr& failure);
  template <class Status>
  std::vector<std::string> gather(std::string_view bytes, const Status& status);

  std::exception_ptr told_; ///< thrown last on all ranks
};

/// A single rank.
class SerialCommunicator final : public Communicator
{
public:
  int rank() const noexcept override { return 0; }
  int size() const noexcept override { return 1; }
  int node_size() const noexcept override { return 1; }
  std::unique_ptr<OutputFile> open_together(const std::string& path) override;

private:
  void do_sum(std::span<std::int64_t>) override {}
  void do_broadcast(std::span<char>, int) override {}
  void do_gather(char*, std::span<const std::int64_t>) override {}
  void do_exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
    std::span<const std::int64_t> to_bytes) override;
};

/// Ends a step of work in which any rank may have failed. Returns on all ranks if none did. Otherwise throws the same on all
/// ranks: the error of the lowest failed rank, of the same kind, place and code, with the rank in its text ("... (on rank 2
/// of 3)", unless all ranks have the same error). Lack of memory becomes a MemoryError, an exception of another kind an Error.
/// Throws Cancelled if some ranks were cancelled and none has an error. A single rank throws its own exception unchanged.
/// failure is null without an error; then no memory is needed. An exception that all ranks have thrown together before is
/// thrown again without waiting.
inline void agree(Communicator& ranks, const std::exception_ptr& failure)
{
  ranks.agree(failure);
}

/// Does work on every rank and agrees on the outcome. Returns the result of the work. The work may be collective; between two
/// collectives any rank may throw. A function with ranks is one do_together, so that it throws on all ranks or on none. It
/// contains another one only where a step must not happen, or must be undone, after a failure on any rank: opening, writing
/// and renaming a shared file, or messages between ranks.
template <class Work>
auto do_together(Communicator& ranks, const Work& work)
{
  constexpr bool gives = !std::is_void_v<std::invoke_result_t<Work>>;
  std::optional<std::conditional_t<gives, std::invoke_result_t<Work>, bool>> result;
  std::exception_ptr failure;
  try
  {
    if constexpr (gives)
    {
      result.emplace(work());
    }
    else
    {
      work();
    }
  }
  catch (...)
  {
    failure = caught_exception();
  }
  agree(ranks, failure);
  if constexpr (gives)
  {
    return std::move(*result);
  }
}

/// Progress of common work; also stops it if another rank has failed.
class SharedProgress final : public Progress
{
public:
  SharedProgress(Progress& own, Communicator& ranks)
    : own_(own)
    , ranks_(ranks)
  {
  }

  bool report(double fraction) override { return own_.report(fraction) && !ranks_.called_off(); }

private:
  Progress& own_;
  Communicator& ranks_;
};
}
#endif
