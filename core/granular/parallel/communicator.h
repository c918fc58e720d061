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
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The processes that work on one thing. All but rank, size, node_size, send and receive are collective:
/// every rank calls them, in the same order. Sizes are 64-bit throughout.
class Communicator
{
public:
  virtual ~Communicator() = default;

  virtual int rank() const noexcept = 0;
  virtual int size() const noexcept = 0;

  /// How many of the ranks, this one among them, run on this machine.
  virtual int node_size() const noexcept = 0;

  /// Gives all ranks the bytes of the root, from 0 to size() - 1.
  virtual void broadcast(std::string& bytes, int root) = 0;

  /// The bytes of every rank, by rank, on all ranks. Meant for what is small.
  virtual std::vector<std::string> all_gather(std::string_view bytes) = 0;

  /// Adds up each value over the ranks, on all ranks.
  virtual void sum(std::span<std::int64_t> values) = 0;

  /// Tells the other ranks at once that this one has failed, so that they need not go on with what they
  /// do: called_off. Not collective, like called_off; agree sees to both, and who cannot come to agree yet may
  /// call it before. Throws nothing for lack of memory.
  virtual void call_off() {}

  /// Whether another rank has called off what this one is doing.
  virtual bool called_off() { return false; }

  /// Ends what call_off began, when all ranks know how many called off.
  virtual void settle(std::int64_t callers) { static_cast<void>(callers); }

  /// Sends each rank its part of `from`, and puts what the ranks send, by rank, into `to`. from_bytes
  /// and to_bytes hold one count of bytes a rank; what to_bytes says must be what is sent.
  virtual void exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
    std::span<const std::int64_t> to_bytes) = 0;

  /// Sends bytes to one other rank, who must receive them; messages between two ranks keep their order.
  /// May wait until they are received. std::logic_error, like receive, if the other is this rank.
  virtual void send(std::string_view bytes, int to) = 0;
  virtual void receive(std::string& bytes, int from) = 0;

  /// A file that all ranks write to at offsets of their own, each from its main thread, or null where
  /// these ranks cannot. Collective, as are its finish, before which all know that all wrote what they
  /// had to (do_together), and its destructor. What fails on one rank fails on all, but for write_at.
  virtual std::unique_ptr<OutputFile> open_together(const std::string& path) = 0;
};

/// The only process.
class SerialCommunicator final : public Communicator
{
public:
  int rank() const noexcept override { return 0; }
  int size() const noexcept override { return 1; }
  int node_size() const noexcept override { return 1; }
  void broadcast(std::string&, int) override {}
  std::vector<std::string> all_gather(std::string_view bytes) override;
  void sum(std::span<std::int64_t>) override {}
  void exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
    std::span<const std::int64_t> to_bytes) override;
  void send(std::string_view bytes, int to) override;
  void receive(std::string& bytes, int from) override;
  std::unique_ptr<OutputFile> open_together(const std::string& path) override;
};

/// Ends a step of work in which any rank may have failed: returns on all ranks if none did, else throws
/// the same on all: the error of the lowest rank that has one, with the rank in its text ("... (on rank
/// 2 of 3)"), of the same kind, place and code; memory that ran out becomes a LimitError, an exception of
/// another kind an Error; Cancelled if some were cancelled and none has an error. A single process
/// throws its own exception as it is. failure is null where nothing is wrong; then this needs no memory.
void agree(Communicator& ranks, const std::exception_ptr& failure);

/// Does work, which must not be collective, on every rank, and agrees on how it went. All that a rank
/// does between two collective calls belongs here, were it to make a string: a rank that throws elsewhere
/// leaves the others waiting.
template <class Work>
void do_together(Communicator& ranks, const Work& work)
{
  std::exception_ptr failure;
  try
  {
    work();
  }
  catch (...)
  {
    failure = std::current_exception();
  }
  agree(ranks, failure);
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
