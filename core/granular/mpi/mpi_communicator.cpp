// SPDX-License-Identifier: BSD-3-Clause
#include "granular/mpi/mpi_communicator.h"

#include "granular/common/error.h"

#include <algorithm>
#include <cstddef>
#include <new>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace granular
{
namespace
{
constexpr int data_tag = 0;
constexpr int call_tag = 1;
constexpr int pair_tag = 2;

void check(int status)
{
  if (status == MPI_SUCCESS)
  {
    return;
  }
  char text[MPI_MAX_ERROR_STRING] = {};
  int length = 0;
  MPI_Error_string(status, text, &length);
  throw IoError("expected the ranks to exchange data, got " +
      std::string(text, static_cast<std::size_t>(length)),
    {}, std::errc::io_error);
}

/// Throws on all ranks of a communicator if one lacks memory.
void expect_memory(MPI_Comm ranks, bool here)
{
  int size = 1;
  int first = 0;
  check(MPI_Comm_size(ranks, &size));
  check(MPI_Comm_rank(ranks, &first));
  first = here ? size : first;
  check(MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, ranks));
  if (first < size)
  {
    throw MemoryError(
      "out of memory (on rank " + std::to_string(first) + " of " + std::to_string(size) + ")");
  }
}

/// Calls call(offset, count) for parts of at most `most`, one behind the other.
template <class Call>
void in_parts(std::int64_t count, std::int64_t most, const Call& call)
{
  for (std::int64_t offset = 0; offset < count; offset += most)
  {
    call(offset, static_cast<int>(std::min(most, count - offset)));
  }
}

/// Waits for messages, and looks into each if something is wrong with any. There is room for the states.
void wait(std::vector<MPI_Request>& messages, std::vector<MPI_Status>& states)
{
  states.resize(messages.size());
  const int status = MPI_Waitall(static_cast<int>(messages.size()), messages.data(), states.data());
  if (status == MPI_ERR_IN_STATUS)
  {
    for (const MPI_Status& state : states)
    {
      check(state.MPI_ERROR == MPI_ERR_PENDING ? MPI_SUCCESS : state.MPI_ERROR);
    }
  }
  check(status);
  messages.clear();
}
}

MpiCommunicator::MpiCommunicator(MPI_Comm ranks, std::int64_t most_bytes)
  : most_bytes_(most_bytes)
{
  check(MPI_Comm_size(ranks, &size_));
  bool has_room = true;
  try
  {
    calls_.reserve(static_cast<std::size_t>(size_));
  }
  catch (const std::bad_alloc&)
  {
    has_room = false;
  }
  expect_memory(ranks, has_room);
  check(MPI_Comm_dup(ranks, &ranks_));
  check(MPI_Comm_set_errhandler(ranks_, MPI_ERRORS_RETURN));
  check(MPI_Comm_rank(ranks_, &rank_));
  MPI_Comm node = MPI_COMM_NULL;
  check(MPI_Comm_split_type(ranks_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &node));
  check(MPI_Comm_size(node, &node_size_));
  check(MPI_Comm_free(&node));
}

std::unique_ptr<MpiCommunicator> MpiCommunicator::make(MPI_Comm ranks)
{
  struct GiveBack
  {
    void operator()(void* room) const noexcept { ::operator delete(room); }
  };
  std::unique_ptr<void, GiveBack> room(::operator new(sizeof(MpiCommunicator), std::nothrow));
  expect_memory(ranks, room != nullptr);
  std::unique_ptr<MpiCommunicator> made(new (room.get()) MpiCommunicator(ranks));
  static_cast<void>(room.release()); // is the object's
  return made;
}

MpiCommunicator::~MpiCommunicator()
{
  int finalized = 0;
  if (MPI_Finalized(&finalized) == MPI_SUCCESS && !finalized)
  {
    MPI_Comm_free(&ranks_);
  }
}

void MpiCommunicator::do_broadcast(std::span<char> bytes, int root)
{
  in_parts(std::ssize(bytes), most_bytes_,
    [&](std::int64_t offset, int part)
    { check(MPI_Bcast(bytes.data() + offset, part, MPI_BYTE, root, ranks_)); });
}

void MpiCommunicator::prepare_gather(std::span<const std::int64_t> counts)
{
  parts_.clear();
  offsets_.clear();
  if (std::accumulate(counts.begin(), counts.end(), std::int64_t{ 0 }) <= most_bytes_)
  {
    parts_.assign(counts.begin(), counts.end());
    offsets_.resize(parts_.size());
    std::exclusive_scan(parts_.begin(), parts_.end(), offsets_.begin(), 0);
  }
}

void MpiCommunicator::do_gather(char* parts, std::span<const std::int64_t> counts)
{
  if (!parts_.empty())
  {
    check(MPI_Allgatherv(
      MPI_IN_PLACE, 0, MPI_BYTE, parts, parts_.data(), offsets_.data(), MPI_BYTE, ranks_));
    return;
  }
  for (int rank = 0; rank < size_; ++rank)
  {
    const std::span part(parts, static_cast<std::size_t>(counts[static_cast<std::size_t>(rank)]));
    this->do_broadcast(part, rank);
    parts += part.size();
  }
}

void MpiCommunicator::call_off()
{
  if (!calls_.empty())
  {
    return; // the others know
  }
  for (int rank = 0; rank < size_; ++rank)
  {
    if (rank != rank_)
    {
      check(MPI_Isend(
        nullptr, 0, MPI_BYTE, rank, call_tag, ranks_, &calls_.emplace_back(MPI_REQUEST_NULL)));
    }
  }
}

bool MpiCommunicator::called_off()
{
  int called = 0;
  check(MPI_Iprobe(MPI_ANY_SOURCE, call_tag, ranks_, &called, MPI_STATUS_IGNORE));
  return called != 0;
}

void MpiCommunicator::settle(std::int64_t callers)
{
  // whose they are does not matter: one that comes early, of what is done next, leaves another behind
  for (std::int64_t call = calls_.empty() ? 0 : 1; call < callers; ++call)
  {
    check(MPI_Recv(nullptr, 0, MPI_BYTE, MPI_ANY_SOURCE, call_tag, ranks_, MPI_STATUS_IGNORE));
  }
  check(MPI_Waitall(static_cast<int>(calls_.size()), calls_.data(), MPI_STATUSES_IGNORE));
  calls_.clear();
}

void MpiCommunicator::do_sum(std::span<std::int64_t> values)
{
  constexpr auto width = static_cast<std::int64_t>(sizeof(std::int64_t));
  in_parts(static_cast<std::int64_t>(values.size()), most_bytes_ / width,
    [&](std::int64_t offset, int part)
    {
      check(
        MPI_Allreduce(MPI_IN_PLACE, values.data() + offset, part, MPI_INT64_T, MPI_SUM, ranks_));
    });
}

void MpiCommunicator::prepare_exchange(
  std::span<const std::int64_t> from_bytes, std::span<const std::int64_t> to_bytes)
{
  const auto parts_of = [&](std::span<const std::int64_t> counts)
  {
    const auto add = [&](std::int64_t sum, std::int64_t count)
    { return sum + (count + most_bytes_ - 1) / most_bytes_; };
    return static_cast<std::size_t>(
      std::accumulate(counts.begin(), counts.end(), std::int64_t{ 0 }, add));
  };
  messages_.reserve(parts_of(from_bytes) + parts_of(to_bytes));
  states_.reserve(messages_.capacity());
}

void MpiCommunicator::do_exchange(const char* from, std::span<const std::int64_t> from_bytes,
  char* to, std::span<const std::int64_t> to_bytes)
{
  const auto begin = [](std::span<const std::int64_t> counts, int rank)
  { return std::accumulate(counts.begin(), counts.begin() + rank, std::int64_t{ 0 }); };
  const auto own = static_cast<std::size_t>(rank_);
  std::copy_n(from + begin(from_bytes, rank_), from_bytes[own], to + begin(to_bytes, rank_));

  // one partner to send to and one to receive from at a time: messages of one pair stay in order
  for (int step = 1; step < size_; ++step)
  {
    const int target = (rank_ + step) % size_;
    const int source = (rank_ - step + size_) % size_;
    in_parts(to_bytes[static_cast<std::size_t>(source)], most_bytes_,
      [&, into = to + begin(to_bytes, source)](std::int64_t offset, int part)
      {
        check(MPI_Irecv(into + offset, part, MPI_BYTE, source, data_tag, ranks_,
          &messages_.emplace_back(MPI_REQUEST_NULL)));
      });
    in_parts(from_bytes[static_cast<std::size_t>(target)], most_bytes_,
      [&, out = from + begin(from_bytes, target)](std::int64_t offset, int part)
      {
        check(MPI_Isend(out + offset, part, MPI_BYTE, target, data_tag, ranks_,
          &messages_.emplace_back(MPI_REQUEST_NULL)));
      });
    wait(messages_, states_);
  }
}

void MpiCommunicator::expect_other(int rank) const
{
  if (rank == rank_)
  {
    throw std::logic_error("expected another rank, got this one");
  }
}

void MpiCommunicator::send(std::string_view bytes, int to)
{
  this->expect_other(to);
  const auto count = static_cast<std::int64_t>(bytes.size());
  check(MPI_Send(&count, 1, MPI_INT64_T, to, pair_tag, ranks_));
  std::int64_t taken = 0; // nothing, if the other lacks memory
  check(MPI_Recv(&taken, 1, MPI_INT64_T, to, pair_tag, ranks_, MPI_STATUS_IGNORE));
  in_parts(taken, most_bytes_,
    [&](std::int64_t offset, int part)
    { check(MPI_Send(bytes.data() + offset, part, MPI_BYTE, to, pair_tag, ranks_)); });
}

void MpiCommunicator::receive(std::string& bytes, int from)
{
  this->expect_other(from);
  std::int64_t count = 0;
  check(MPI_Recv(&count, 1, MPI_INT64_T, from, pair_tag, ranks_, MPI_STATUS_IGNORE));
  const auto answer = [&](std::int64_t taken)
  { check(MPI_Send(&taken, 1, MPI_INT64_T, from, pair_tag, ranks_)); };
  try
  {
    bytes.resize(static_cast<std::size_t>(count));
  }
  catch (const std::bad_alloc&)
  {
    answer(0);
    throw;
  }
  answer(count);
  in_parts(count, most_bytes_,
    [&](std::int64_t offset, int part)
    {
      check(
        MPI_Recv(bytes.data() + offset, part, MPI_BYTE, from, pair_tag, ranks_, MPI_STATUS_IGNORE));
    });
}
}
