// SPDX-License-Identifier: BSD-3-Clause
#include "granular/parallel/communicator.h"

#include "granular/common/pass.h"
#include "granular/common/progress.h"

#include <algorithm>
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
  catch (const IoError& error)
  {
    return { Kind::Io, error.text(), error.where(), error.code() };
  }
  catch (const FormatError& error)
  {
    return { Kind::Format, error.text(), error.where() };
  }
  catch (const LimitError& error)
  {
    return { Kind::Limit, error.text(), error.where() };
  }
  catch (const UnsupportedError& error)
  {
    return { Kind::Unsupported, error.text(), error.where() };
  }
  catch (const Error& error)
  {
    return { Kind::Other, error.text(), error.where() };
  }
  catch (const std::bad_alloc&)
  {
    return { Kind::Limit, "out of memory" };
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
    return { Kind::Limit, "out of memory" };
  }
  Failure failure;
  ArchiveReader unpacker{ bytes };
  pass(unpacker, failure);
  return failure;
}
}

std::vector<std::string> SerialCommunicator::all_gather(std::string_view bytes)
{
  return { std::string(bytes) };
}

void SerialCommunicator::exchange(const char* from, std::span<const std::int64_t> from_bytes,
  char* to, std::span<const std::int64_t>)
{
  std::copy_n(from, from_bytes[0], to);
}

void SerialCommunicator::send(std::string_view, int)
{
  throw std::logic_error("expected another rank, got the only one");
}

void SerialCommunicator::receive(std::string&, int)
{
  throw std::logic_error("expected another rank, got the only one");
}

std::unique_ptr<OutputFile> SerialCommunicator::open_together(const std::string& path)
{
  return std::make_unique<NewFile>(path);
}

void agree(Communicator& ranks, const std::exception_ptr& failure)
{
  if (ranks.size() == 1)
  {
    if (failure)
    {
      std::rethrow_exception(failure);
    }
    return;
  }
  if (failure)
  {
    ranks.call_off();
  }
  std::int64_t failed = failure ? 1 : 0;
  ranks.sum({ &failed, 1 });
  if (failed == 0)
  {
    return;
  }
  ranks.settle(failed);
  const std::vector<std::string> answers = ranks.all_gather(pack(failure));
  bool cancelled = false;
  for (std::size_t rank = 0; rank < answers.size(); ++rank)
  {
    if (answers[rank].empty())
    {
      continue;
    }
    const Failure told = unpack_failure(answers[rank]);
    if (told.kind != Kind::Cancelled)
    {
      raise(
        told, " (on rank " + std::to_string(rank) + " of " + std::to_string(answers.size()) + ")");
    }
    cancelled = true;
  }
  if (cancelled)
  {
    throw Cancelled{};
  }
}
}
