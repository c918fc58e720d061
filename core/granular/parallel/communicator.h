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
/// The ranks that work on one thing. All functions but rank, size, node_size, send and receive are collective: every rank calls
/// them, in the same order. Sizes are 64-bit throughout.
///
/// Each collective begins with an exchange of status. A rank that threw since the last collective takes part in that exchange with
/// its exception (do_together, agree), and the collective throws the same on all ranks: none waits for one that has left.
class Communicator
{
public:
  virtual ~Communicator() = default;

  virtual int rank() const noexcept = 0;
  virtual int size() const noexcept = 0;

  /// Returns how many of the ranks, this one among them, run on this machine.
  virtual int node_size() const noexcept = 0;

  /// Gives all ranks the bytes of the root, from 0 to size() - 1. Throws LimitError on all where one has no memory for them.
  void broadcast(std::string& bytes, int root);

  /// Returns the bytes of every rank, by rank, on all ranks; meant for what is small. Throws LimitError on all where one has no
  /// memory for them.
  std::vector<std::string> all_gather(std::string_view bytes);

  /// Adds up each value over the ranks, on all ranks.
  void sum(std::span<std::int64_t> values);

  /// Sends each rank its part of `from`, and puts what the ranks send, by rank, into `to`. from_bytes and to_bytes hold one count
  /// of bytes a rank; to_bytes must say what is sent.
  void exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
    std::span<const std::int64_t> to_bytes);

  /// Exchanges status, and nothing else: see agree.
  void agree(const std::exception_ptr& failure) { this->meet(failure, {}); }

  /// Tells the other ranks at once that this one has failed, so that they need not go on with what they do: called_off. Not
  /// collective, like called_off. The exchange of status does so; a rank that cannot come to it yet may call this before.
  /// Throws nothing for lack of memory.
  virtual void call_off() {}

  /// Returns whether another rank has called off what this one is doing.
  virtual bool called_off() { return false; }

  /// Sends bytes to one other rank, who must receive them; messages between two ranks keep their order.
  /// May wait until they are received. Throws std::logic_error, like receive, if the other is this rank.
  virtual void send(std::string_view bytes, int to) = 0;
  virtual void receive(std::string& bytes, int from) = 0;

  /// Returns a file that all ranks write to at offsets of their own, each from its main thread, or null where
  /// these ranks cannot. Collective, as are its finish, before which all know that all wrote what they
  /// had to (do_together), and its destructor. What fails on one rank fails on all, but for write_at.
  virtual std::unique_ptr<OutputFile> open_together(const std::string& path) = 0;

protected:
  /// What the functions above are made of, on several ranks alone. No rank has failed when these are called.
  virtual void do_sum(std::span<std::int64_t> values) = 0;
  virtual void do_broadcast(std::span<char> bytes, int root) = 0;
  /// Fills the parts of the other ranks, by rank, of which counts tells the bytes. prepare comes before: what needs memory.
  virtual void prepare_gather(std::span<const std::int64_t>) {}
  virtual void do_gather(char* parts, std::span<const std::int64_t> counts) = 0;
  virtual void prepare_exchange(std::span<const std::int64_t>, std::span<const std::int64_t>) {}
  virtual void do_exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
    std::span<const std::int64_t> to_bytes) = 0;

  /// Ends what call_off began, when all ranks know how many called off.
  virtual void settle(std::int64_t callers) { static_cast<void>(callers); }

private:
  /// Values that are added up together with the status.
  static constexpr std::size_t most_beside = 15;

  std::int64_t add_up(bool failed, std::span<std::int64_t> beside);
  void meet(const std::exception_ptr& failure, std::span<std::int64_t> beside);
  [[noreturn]] void fail_together(const std::exception_ptr& failure);
  template <class Status>
  std::vector<std::string> gather(std::string_view bytes, const Status& status);

  std::exception_ptr told_; ///< thrown last on all ranks
};

/// The only rank.
class SerialCommunicator final : public Communicator
{
public:
  int rank() const noexcept override { return 0; }
  int size() const noexcept override { return 1; }
  int node_size() const noexcept override { return 1; }
  void send(std::string_view bytes, int to) override;
  void receive(std::string& bytes, int from) override;
  std::unique_ptr<OutputFile> open_together(const std::string& path) override;

private:
  void do_sum(std::span<std::int64_t>) override {}
  void do_broadcast(std::span<char>, int) override {}
  void do_gather(char*, std::span<const std::int64_t>) override {}
  void do_exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
    std::span<const std::int64_t> to_bytes) override;
};

/// Ends a step of work in which any rank may have failed: returns on all ranks if none did, else throws
/// the same on all: the error of the lowest rank that has one, with the rank in its text ("... (on rank
/// 2 of 3)"; not where all have the same), of the same kind, place and code; memory that ran out becomes a LimitError, an exception of
/// another kind an Error; Cancelled if some were cancelled and none has an error. A single process
/// throws its own exception as it is. failure is null where nothing is wrong; then this needs no memory. An exception that all
/// ranks have thrown together before is thrown again, and no rank waits.
inline void agree(Communicator& ranks, const std::exception_ptr& failure)
{
  ranks.agree(failure);
}

/// Does work on every rank, and agrees on how it went. Returns what the work returns. The work may be collective; between two
/// collectives any rank may throw. A function that others call with ranks is one do_together, so that it throws on all ranks or
/// on none. Within it another is needed where something must not be done, or not be left, if a rank failed before: where a file
/// that is opened together is written or renamed, or where messages go from rank to rank.
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
    failure = std::current_exception();
  }
  agree(ranks, failure);
  if constexpr (gives)
  {
    return std::move(*result);
  }
}

/// Progress of work that is done together: stops it also where another rank has failed.
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
