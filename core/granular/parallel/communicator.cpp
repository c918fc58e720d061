// SPDX-License-Identifier: BSD-3-Clause
#include "granular/parallel/communicator.h"

#include "granular/common/error.h"
#include "granular/common/pass.h"
#include "granular/common/progress.h"
#include "granular/common/shares.h"

#include <algorithm>
#include <array>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace granular
{
namespace
{
enum class Kind : char
{
  Cancelled,
  Io,
  Format,
  Limit,
  Memory,
  Unsupported,
  Other
};

/// An exception as ranks tell it to each other.
struct Failure
{
  Kind kind = Kind::Other;
  std::string text = {};
  Where where = {};
  std::errc code = {};
};

template <class Known>
bool is(const Error& error) noexcept
{
  return dynamic_cast<const Known*>(&error) != nullptr;
}

Kind kind_of(const Error& error) noexcept
{
  return is<IoError>(error)       ? Kind::Io
    : is<FormatError>(error)      ? Kind::Format
    : is<MemoryError>(error)      ? Kind::Memory // before what it is, too
    : is<LimitError>(error)       ? Kind::Limit
    : is<UnsupportedError>(error) ? Kind::Unsupported
                                  : Kind::Other;
}

Failure describe(const std::exception_ptr& failure)
{
  try
  {
    std::rethrow_exception(failure);
  }
  catch (const Cancelled&)
  {
    return { Kind::Cancelled };
  }
  catch (const Error& error)
  {
    const auto* const io = dynamic_cast<const IoError*>(&error);
    return { kind_of(error), error.text(), error.where(), io ? io->code() : std::errc{} };
  }
  catch (const std::bad_alloc&)
  {
    return { Kind::Memory, "out of memory" };
  }
  catch (const std::exception& other)
  {
    return { Kind::Other, other.what() };
  }
  catch (...)
  {
    return { Kind::Other, "an exception of an unknown kind" };
  }
}

[[noreturn]] void raise(const Failure& failure, const std::string& rank)
{
  const std::string text = failure.text + rank;
  switch (failure.kind)
  {
    case Kind::Io:
      throw IoError(text, failure.where, failure.code);
    case Kind::Format:
      throw FormatError(text, failure.where);
    case Kind::Limit:
      throw LimitError(text, failure.where);
    case Kind::Memory:
      throw MemoryError(text, failure.where);
    case Kind::Unsupported:
      throw UnsupportedError(text, failure.where);
    case Kind::Cancelled: // agree() sees to that
    case Kind::Other:
      break;
  }
  throw Error(text, failure.where);
}

template <class Archive>
void pass(Archive& archive, Failure& failure)
{
  archive.number(failure.kind);
  archive.text(failure.text);
  pass(archive, failure.where);
  archive.number(failure.code);
}

constexpr std::string_view no_memory_to_say_so = "!";

/// Nothing where nothing is wrong. Does not throw: the other ranks wait for an answer.
std::string pack(const std::exception_ptr& failure) noexcept
{
  if (!failure)
  {
    return {};
  }
  try
  {
    Failure described = describe(failure);
    ArchiveWriter packer;
    pass(packer, described);
    return std::move(packer.bytes);
  }
  catch (...)
  {
    return std::string(no_memory_to_say_so);
  }
}

Failure unpack_failure(std::string_view bytes)
{
  if (bytes == no_memory_to_say_so)
  {
    return { Kind::Memory, "out of memory" };
  }
  Failure failure;
  ArchiveReader unpacker{ bytes };
  pass(unpacker, failure);
  return failure;
}

template <class Work>
std::exception_ptr attempt(const Work& work) noexcept
{
  try
  {
    work();
    return {};
  }
  catch (...)
  {
    return std::current_exception();
  }
}
}

/// Adds up the status of all ranks, and a few values beside it. Returns how many ranks have failed.
std::int64_t Communicator::add_up(bool failed, std::span<std::int64_t> beside)
{
  std::array<std::int64_t, most_beside + 1> values = { failed ? 1 : 0 };
  std::ranges::copy(beside, values.begin() + 1);
  this->do_sum(values); // as many in every collective: they must meet
  std::copy_n(values.begin() + 1, beside.size(), beside.begin());
  return values[0];
}

void Communicator::meet(const std::exception_ptr& failure, std::span<std::int64_t> beside)
{
  if (failure && (this->size() == 1 || failure == told_))
  {
    std::rethrow_exception(failure);
  }
  if (this->size() == 1)
  {
    return;
  }
  if (failure)
  {
    this->call_off();
  }
  const std::int64_t failed = this->add_up(failure != nullptr, beside);
  if (failed == 0)
  {
    return;
  }
  this->settle(failed);
  try
  {
    this->fail_together(failure);
  }
  catch (...)
  {
    told_ = std::current_exception();
    throw;
  }
}

/// Throws the error of the lowest rank that has one; without its rank if all have the same.
void Communicator::fail_together(const std::exception_ptr& failure)
{
  const auto status = [this](const std::exception_ptr& own, std::span<std::int64_t> beside)
  {
    if (this->add_up(own != nullptr, beside) > 0)
    {
      throw MemoryError("out of memory");
    }
  };
  const std::vector<std::string> answers = this->gather(pack(failure), status);
  const bool same = std::ranges::all_of(
    answers, [&](const std::string& answer) { return answer == answers.front(); });
  for (std::size_t rank = 0; rank < answers.size(); ++rank)
  {
    if (answers[rank].empty())
    {
      continue;
    }
    const Failure told = unpack_failure(answers[rank]);
    if (told.kind != Kind::Cancelled)
    {
      const std::string where =
        " (on rank " + std::to_string(rank) + " of " + std::to_string(answers.size()) + ")";
      raise(told, same ? "" : where);
    }
  }
  throw Cancelled{};
}

/// status(failure, values) adds up values over the ranks and throws on all if one has failed.
template <class Status>
std::vector<std::string> Communicator::gather(std::string_view bytes, const Status& status)
{
  const auto own = static_cast<std::size_t>(this->rank());
  std::array<std::int64_t, most_beside> few = {};
  std::vector<std::int64_t> counts;
  std::vector<std::string> all;
  std::string joined;
  const std::exception_ptr no_room = attempt(
    [&]
    {
      counts.resize(static_cast<std::size_t>(this->size()));
      all.resize(counts.size());
    });
  const bool fits = static_cast<std::size_t>(this->size()) <= few.size();
  few[fits ? own : 0] = fits ? static_cast<std::int64_t>(bytes.size()) : 0;
  status(no_room, few);
  if (fits)
  {
    std::copy_n(few.begin(), counts.size(), counts.begin());
  }
  else
  {
    counts[own] = static_cast<std::int64_t>(bytes.size());
    this->do_sum(counts);
  }
  const std::int64_t total = sum_of(counts);
  if (total == 0)
  {
    return all;
  }
  status(attempt(
           [&]
           {
             joined.resize(static_cast<std::size_t>(total));
             for (std::size_t rank = 0; rank < all.size(); ++rank)
             {
               all[rank].reserve(static_cast<std::size_t>(counts[rank]));
             }
             this->prepare_gather(counts);
           }),
    {});
  std::ranges::copy(bytes, joined.begin() + sum_of(std::span(counts).first(own)));
  this->do_gather(joined.data(), counts);
  std::size_t begin = 0;
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    all[rank].assign(joined, begin, static_cast<std::size_t>(counts[rank]));
    begin += static_cast<std::size_t>(counts[rank]);
  }
  return all;
}

std::vector<std::string> Communicator::all_gather(std::string_view bytes)
{
  if (this->size() == 1)
  {
    return { std::string(bytes) };
  }
  return this->gather(bytes,
    [this](const std::exception_ptr& failure, std::span<std::int64_t> beside)
    { this->meet(failure, beside); });
}

void Communicator::broadcast(std::string& bytes, int root)
{
  auto count = this->rank() == root ? static_cast<std::int64_t>(bytes.size()) : std::int64_t{ 0 };
  this->meet({}, { &count, 1 });
  if (this->size() == 1)
  {
    return;
  }
  if (count == 0)
  {
    bytes.clear();
    return;
  }
  this->meet(attempt([&] { bytes.resize(static_cast<std::size_t>(count)); }), {});
  this->do_broadcast(bytes, root);
}

void Communicator::sum(std::span<std::int64_t> values)
{
  const bool few = values.size() <= most_beside;
  this->meet({}, few ? values : std::span<std::int64_t>());
  if (!few)
  {
    this->do_sum(values);
  }
}

void Communicator::exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
  std::span<const std::int64_t> to_bytes)
{
  this->meet(attempt([&] { this->prepare_exchange(from_bytes, to_bytes); }), {});
  this->do_exchange(from, from_bytes, to, to_bytes);
}

void SerialCommunicator::do_exchange(const char* from, std::span<const std::int64_t> from_bytes,
  char* to, std::span<const std::int64_t>)
{
  std::copy_n(from, from_bytes[0], to);
}

void Communicator::send(std::string_view, int)
{
  throw std::logic_error("expected another rank, and ranks with messages");
}

void Communicator::receive(std::string&, int)
{
  throw std::logic_error("expected another rank, and ranks with messages");
}

std::unique_ptr<OutputFile> SerialCommunicator::open_together(const std::string& path)
{
  return std::make_unique<NewFile>(path);
}
}
