// SPDX-License-Identifier: BSD-3-Clause
#include "caller_ranks.h"

#include "granular/common/error.h"
#include "granular/common/shares.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>

namespace granular_c
{
using namespace granular;

namespace
{
/// Bytes of each rank in a part: whole integers, and little memory for all ranks.
std::size_t part_bytes(int ranks)
{
  constexpr std::size_t all = std::size_t{ 1 } << 20;
  constexpr std::size_t least = std::size_t{ 1 } << 12;
  return std::max(
    least, all / static_cast<std::size_t>(ranks) / sizeof(std::int64_t) * sizeof(std::int64_t));
}

/// Copies what two ranges of bytes share: those of a part, which begins at `offset` of all that its rank sends, and the wanted ones from
/// `begin` on.
void copy_shared(
  std::string_view part, std::size_t offset, std::int64_t begin, std::int64_t count, char* to)
{
  const auto first = static_cast<std::size_t>(begin);
  const std::size_t from = std::max(first, offset);
  const std::size_t end = std::min(first + static_cast<std::size_t>(count), offset + part.size());
  if (from < end)
  {
    std::memcpy(to + (from - first), part.data() + (from - offset), end - from);
  }
}
}

CallerRanks::CallerRanks(const granular_ranks& given)
  : ranks_(given)
{
  if (given.all_gather == nullptr || given.rank < 0 || given.rank >= given.size)
  {
    throw ArgumentError(
      "expected ranks with a function all_gather and a rank from 0 to size - 1, got rank " +
      std::to_string(given.rank) + " of " + std::to_string(given.size));
  }
  mine_.resize(part_bytes(given.size));
  all_.resize(mine_.size() * static_cast<std::size_t>(given.size));
}

/// Gathers up to `most` bytes of each rank; what a rank has less is noise. take(rank, offset, bytes) gets them part by part, and may change
/// those of `mine` that it was given.
template <class Take>
void CallerRanks::gather_parts(std::string_view mine, std::size_t most, const Take& take)
{
  for (std::size_t offset = 0; offset < most; offset += mine_.size())
  {
    const std::size_t bytes = std::min(mine_.size(), most - offset);
    std::ranges::copy(mine.substr(std::min(offset, mine.size()), bytes), mine_.begin());
    failed_ = failed_ || ranks_.all_gather(mine_.data(), all_.data(), bytes, ranks_.user) != 0;
    if (failed_)
    {
      throw std::runtime_error("expected all_gather to return 0, got another value");
    }
    for (std::size_t rank = 0; rank < static_cast<std::size_t>(ranks_.size); ++rank)
    {
      take(rank, offset, std::string_view(all_.data() + rank * bytes, bytes));
    }
  }
}

void CallerRanks::do_sum(std::span<std::int64_t> values)
{
  const auto bytes = std::as_bytes(values);
  gather_parts({ reinterpret_cast<const char*>(bytes.data()), bytes.size() }, bytes.size(),
    [&](std::size_t rank, std::size_t offset, std::string_view part)
    {
      for (std::size_t i = 0; i < part.size() / sizeof(std::int64_t); ++i)
      {
        std::int64_t value = 0;
        std::memcpy(&value, part.data() + i * sizeof(value), sizeof(value));
        std::int64_t& total = values[offset / sizeof(value) + i];
        total = rank == 0 ? value : total + value;
      }
    });
}

void CallerRanks::do_broadcast(std::span<char> bytes, int root)
{
  const std::string_view mine(bytes.data(), ranks_.rank == root ? bytes.size() : 0);
  gather_parts(mine, bytes.size(),
    [&](std::size_t rank, std::size_t offset, std::string_view part)
    {
      if (rank == static_cast<std::size_t>(root))
      {
        std::ranges::copy(part, bytes.begin() + static_cast<std::ptrdiff_t>(offset));
      }
    });
}

void CallerRanks::do_gather(char* parts, std::span<const std::int64_t> counts)
{
  const auto own = static_cast<std::size_t>(ranks_.rank);
  const std::string_view mine(
    parts + sum_of(counts.first(own)), static_cast<std::size_t>(counts[own]));
  gather_parts(mine, static_cast<std::size_t>(std::ranges::max(counts)),
    [&](std::size_t rank, std::size_t offset, std::string_view part)
    { copy_shared(part, offset, 0, counts[rank], parts + sum_of(counts.first(rank))); });
}

void CallerRanks::prepare_exchange(std::span<const std::int64_t>, std::span<const std::int64_t>)
{
  const auto size = static_cast<std::size_t>(ranks_.size);
  exchanged_.resize(size * size);
  row_bytes_.assign(size, static_cast<std::int64_t>(size * sizeof(std::int64_t)));
}

void CallerRanks::do_exchange(const char* from, std::span<const std::int64_t> from_bytes, char* to,
  std::span<const std::int64_t> to_bytes)
{
  const auto own = static_cast<std::size_t>(ranks_.rank);
  const std::size_t size = from_bytes.size();
  std::ranges::copy(from_bytes, exchanged_.begin() + static_cast<std::ptrdiff_t>(own * size));
  do_gather(reinterpret_cast<char*>(exchanged_.data()), row_bytes_);
  std::int64_t most = 0;
  for (std::size_t rank = 0; rank < size; ++rank)
  {
    most = std::max(most, sum_of(std::span(exchanged_).subspan(rank * size, size)));
  }
  gather_parts({ from, static_cast<std::size_t>(sum_of(from_bytes)) },
    static_cast<std::size_t>(most),
    [&](std::size_t rank, std::size_t offset, std::string_view part)
    {
      const std::span<const std::int64_t> row = std::span(exchanged_).subspan(rank * size, size);
      copy_shared(
        part, offset, sum_of(row.first(own)), row[own], to + sum_of(to_bytes.first(rank)));
    });
}

std::unique_ptr<Communicator> make_ranks(const granular_ranks* given)
{
  if (given == nullptr)
  {
    return std::make_unique<SerialCommunicator>();
  }
  return std::make_unique<CallerRanks>(*given);
}
}
