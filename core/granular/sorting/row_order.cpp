// SPDX-License-Identifier: BSD-3-Clause
#include "granular/sorting/sort_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <memory>
#include <numeric>
#include <utility>

namespace granular
{
namespace
{
using Row = std::uint64_t;

Row* rows_of(const Block& block) noexcept
{
  return static_cast<Row*>(block.data());
}

/// Sorts by the bits from low to high, and keeps the order of what is equal in these. spare is as large
/// as rows. Digits of 11 bits keep their counters and the ends of their runs in the nearest caches.
void sort_by_bits(Block& rows, Block& spare, std::size_t count, int low, int high)
{
  constexpr int most_bits = 11;
  const int passes = (high - low + most_bits - 1) / most_bits;
  for (int pass = 0; pass < passes; ++pass)
  {
    const int shift = low + (high - low) * pass / passes;
    const int bits = low + (high - low) * (pass + 1) / passes - shift;
    const Row mask = (Row{ 1 } << bits) - 1;
    std::array<std::size_t, std::size_t{ 1 } << most_bits> ends = {};
    const std::span<Row> from(rows_of(rows), count);
    for (const Row row : from)
    {
      ++ends[row >> shift & mask];
    }
    std::exclusive_scan(ends.begin(), ends.end(), ends.begin(), std::size_t{ 0 });
    Row* const to = rows_of(spare);
    for (const Row row : from)
    {
      to[ends[row >> shift & mask]++] = row;
    }
    std::swap(rows, spare);
  }
}

/// Ids and rows that together fit into 64 bits: ids above rows, as one number.
Block sort_packed(std::span<const std::int64_t> ids, std::int64_t lowest, int id_bits, int row_bits)
{
  Block rows(ids.size() * sizeof(Row));
  Block spare(ids.size() * sizeof(Row));
  for (std::size_t row = 0; row < ids.size(); ++row)
  {
    const Row id = static_cast<Row>(ids[row]) - static_cast<Row>(lowest);
    rows_of(rows)[row] = id << row_bits | row;
  }
  sort_by_bits(rows, spare, ids.size(), row_bits, row_bits + id_bits);
  const Row mask = (Row{ 1 } << row_bits) - 1;
  for (Row& row : std::span(rows_of(rows), ids.size()))
  {
    row &= mask;
  }
  return rows;
}

/// Any ids, such as hashes.
Block sort_wide(std::span<const std::int64_t> ids)
{
  struct Place
  {
    std::int64_t id;
    Row row;

    auto operator<=>(
      const Place&) const = default; // rows differ: the order is that of a stable sort
  };
  const auto places = std::make_unique_for_overwrite<Place[]>(ids.size());
  for (std::size_t row = 0; row < ids.size(); ++row)
  {
    places[row] = { ids[row], row };
  }
  std::sort(places.get(), places.get() + ids.size());
  Block rows(ids.size() * sizeof(Row));
  std::transform(places.get(), places.get() + ids.size(), rows_of(rows),
    [](const Place& place) { return place.row; });
  return rows;
}

/// known: the width where the compiler knows it, which makes a copy one or two moves, not a call; else 0.
template <std::size_t known>
void gather(const char* from, std::span<const Row> rows, std::size_t any, char* to)
{
  const std::size_t width = known != 0 ? known : any;
  for (const Row row : rows)
  {
    std::memcpy(to, from + row * width, width);
    to += width;
  }
}

using Gather = void (*)(const char*, std::span<const Row>, std::size_t, char*);

Gather gather_of(std::size_t width)
{
  constexpr std::pair<std::size_t, Gather> known[] = { { 4, gather<4> }, { 8, gather<8> },
    { 12, gather<12> }, { 24, gather<24> } };
  const auto* const found = std::ranges::find(known, width, &std::pair<std::size_t, Gather>::first);
  return found != std::end(known) ? found->second : gather<0>;
}
}

RowOrder::RowOrder(std::span<const std::int64_t> ids)
{
  if (std::is_sorted(ids.begin(), ids.end()))
  {
    return;
  }
  const auto [lowest, highest] = std::minmax_element(ids.begin(), ids.end());
  const auto id_bits =
    static_cast<int>(std::bit_width(static_cast<Row>(*highest) - static_cast<Row>(*lowest)));
  const auto row_bits = static_cast<int>(std::bit_width(ids.size() - 1));
  rows_ = id_bits + row_bits <= 64 ? sort_packed(ids, *lowest, id_bits, row_bits) : sort_wide(ids);
}

void RowOrder::apply(Block& block, std::size_t width, const Executor& executor) const
{
  if (rows_.bytes() == 0 || block.bytes() == 0)
  {
    return;
  }
  constexpr std::size_t chunk_rows = std::size_t{ 1 } << 15;
  const std::span<const Row> rows(rows_of(rows_), rows_.bytes() / sizeof(Row));
  const Gather gather = gather_of(width);
  Block sorted(block.bytes(), block.pool());
  const auto* const from = static_cast<const char*>(block.data());
  auto* const to = static_cast<char*>(sorted.data());
  Progress quiet; // a moment, next to what was read
  executor.for_each_stretch(
    rows.size(), chunk_rows,
    [&](std::size_t first, std::size_t count, std::size_t)
    { gather(from, rows.subspan(first, count), width, to + first * width); },
    quiet);
  block = std::move(sorted);
}
}
