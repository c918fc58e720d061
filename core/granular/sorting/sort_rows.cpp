// SPDX-License-Identifier: BSD-3-Clause
#include "granular/sorting/sort_rows.h"

#include "granular/common/shares.h"
#include "granular/parallel/trade.h"
#include "granular/sorting/text_dictionary.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

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

/// Returns the rows in the order of their ids, which stand above the rows in numbers of 64 bits, as many bits of them at a time
/// as there is room for. The ids of most frames fit at once.
Block sort_rows_by(
  std::span<const std::int64_t> ids, std::int64_t lowest, int id_bits, int row_bits)
{
  Block sorted(ids.size() * sizeof(Row));
  Block spare(ids.size() * sizeof(Row));
  const Row mask = (Row{ 1 } << row_bits) - 1;
  const int room = 64 - row_bits;
  for (int low = 0; low < id_bits; low += room)
  {
    Row* const rows = rows_of(sorted);
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      const Row row = low == 0 ? i : rows[i];
      rows[i] = (static_cast<Row>(ids[row]) - static_cast<Row>(lowest)) >> low << row_bits | row;
    }
    sort_by_bits(sorted, spare, ids.size(), row_bits, row_bits + std::min(room, id_bits - low));
    for (Row& row : std::span(rows_of(sorted), ids.size()))
    {
      row &= mask;
    }
  }
  return sorted;
}

/// known: the width where the compiler knows it, which makes a copy one or two moves, not a call; else 0.
template <std::size_t known>
void gather_rows(const char* from, std::span<const Row> rows, std::size_t any, char* to)
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
  constexpr std::pair<std::size_t, Gather> known[] = { { 4, gather_rows<4> }, { 8, gather_rows<8> },
    { 12, gather_rows<12> }, { 24, gather_rows<24> } };
  const auto* const found = std::ranges::find(known, width, &std::pair<std::size_t, Gather>::first);
  return found != std::end(known) ? found->second : gather_rows<0>;
}

/// An order of rows that can be applied to many blocks.
class RowOrder
{
public:
  /// Makes the order by id; rows with the same id keep their order. Throws std::bad_alloc.
  explicit RowOrder(std::span<const std::int64_t> ids)
  {
    if (std::is_sorted(ids.begin(), ids.end()))
    {
      return;
    }
    const auto [lowest, highest] = std::minmax_element(ids.begin(), ids.end());
    const auto id_bits =
      static_cast<int>(std::bit_width(static_cast<Row>(*highest) - static_cast<Row>(*lowest)));
    const auto row_bits = static_cast<int>(std::bit_width(ids.size() - 1));
    rows_ = sort_rows_by(ids, *lowest, id_bits, row_bits);
  }

  /// Brings the rows of a block, width bytes each, into this order. Empty blocks are unchanged. Throws std::bad_alloc.
  void apply(Block& block, std::size_t width, const Executor& executor) const
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

private:
  Block rows_; ///< Row: from where each row comes; empty: they stay
};

const std::int64_t* find_ids(const Table& frame, const Block& ids) noexcept
{
  const auto found = std::ranges::find_if(frame.arrays,
    [](const TableArray& array)
    { return array.info.role == ColumnRole::Id && array.info.type == ValueType::Int64; });
  return static_cast<const std::int64_t*>(
    found == frame.arrays.end() ? ids.data() : found->block.data());
}

std::size_t row_width(const TableArray& array) noexcept
{
  return size_of(array.info.type) * array.info.columns.size();
}

/// Bytes of a point; 0 where there are no rows.
std::size_t point_width(const Table& frame) noexcept
{
  return frame.rows > 0 ? frame.points.bytes() / static_cast<std::size_t>(frame.rows) : 0;
}

/// Calls call(block, width) for all that has a value a row.
template <class Call>
void for_each_block(Table& frame, std::size_t width_of_points, const Call& call)
{
  call(frame.points, width_of_points);
  for (TableArray& array : frame.arrays)
  {
    call(array.block, row_width(array));
  }
}

/// Facts about the rows of a rank, or of all, before they move.
struct Survey
{
  std::int64_t rows = 0;
  std::size_t point_width = 0; ///< bytes; 0 where there are no rows
  bool has_ids = false;
};

/// The arrays: what must be the same on all ranks.
std::string shape_of(const Table& frame)
{
  std::string shape;
  for (const TableArray& array : frame.arrays)
  {
    shape += array.info.name + ' ' + std::to_string(static_cast<int>(array.info.type)) + ' ' +
      std::to_string(array.info.components()) + '\n';
  }
  return shape;
}

Survey survey(const Table& frame, bool has_ids, Communicator& ranks)
{
  const std::vector<std::string> shapes = ranks.all_gather(shape_of(frame));
  if (std::ranges::any_of(shapes, [&](const std::string& one) { return one != shapes.front(); }))
  {
    throw Error("expected the same arrays on all ranks, got others");
  }
  Survey sum;
  bool lacking = false; // a rank with rows has no ids
  for (const Survey& own : gather(ranks, Survey{ frame.rows, point_width(frame), has_ids }))
  {
    sum.rows += own.rows;
    sum.point_width = std::max(sum.point_width, own.point_width);
    sum.has_ids = sum.has_ids || own.has_ids;
    lacking = lacking || (own.rows > 0 && !own.has_ids);
  }
  sum.has_ids = sum.has_ids && !lacking;
  return sum;
}

/// Gives a column of texts the words of all ranks, in the order in which they first occur.
void join_words(TableArray& array, Communicator& ranks, std::int64_t rows, const Where& where)
{
  TextDictionary words;
  for (const std::vector<std::string>& of_rank : gather(ranks, array.words))
  {
    for (const std::string& word : of_rank)
    {
      words.index(word, where);
    }
  }
  std::vector<std::int32_t> renumbered; // by the index of a word here
  for (const std::string& word : array.words)
  {
    renumbered.push_back(words.index(word, where));
  }
  array.words = words.take();
  auto* const indices = static_cast<std::int32_t*>(array.block.data());
  std::transform(indices, indices + rows, indices,
    [&](std::int32_t index) { return renumbered[static_cast<std::size_t>(index)]; });
}

std::span<const std::int64_t> ids_in(const Block& block) noexcept
{
  return { static_cast<const std::int64_t*>(block.data()), block.bytes() / sizeof(std::int64_t) };
}

/// Returns the numbers of the sorted ids of this rank that go to each rank.
std::vector<std::int64_t> count_parts(
  std::int64_t rows, std::span<const std::int64_t> sorted, Communicator& ranks)
{
  const auto size = static_cast<std::size_t>(ranks.size());
  std::vector<std::int64_t> places(size);
  std::vector<std::int64_t> begins(size);
  std::vector<std::int64_t> equal(size);
  for (int rank = 0; rank < ranks.size(); ++rank)
  {
    places[static_cast<std::size_t>(rank)] = begin_of_part(rows, rank, ranks.size());
  }
  const std::vector<std::int64_t> cuts = find_ids_at(places, sorted, ranks);
  for (std::size_t i = 0; i < size; ++i)
  {
    const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), cuts[i]);
    begins[i] = first - sorted.begin();
    equal[i] = last - first;
  }
  std::vector<std::int64_t> before = begins;
  ranks.sum(before);

  // the cut at which its part begins is drawn by each rank
  const auto own = static_cast<std::size_t>(ranks.rank());
  std::int64_t left = places[own] - before[own];
  std::vector<std::int64_t> shares = swap_numbers(equal, ranks);
  for (std::int64_t& share : shares)
  {
    share = std::min(share, left);
    left -= share;
  }
  shares = swap_numbers(shares, ranks);
  std::transform(begins.begin(), begins.end(), shares.begin(), begins.begin(), std::plus<>());

  std::vector<std::int64_t> counts(begins.begin() + 1, begins.end());
  counts.push_back(static_cast<std::int64_t>(sorted.size()));
  std::transform(counts.begin(), counts.end(), begins.begin(), counts.begin(), std::minus<>());
  return counts;
}

/// Collective.
void sort_together(Table& frame, const Block& ids, Communicator& ranks, Notices& notices,
  const Where& where, const Executor& executor)
{
  const std::int64_t* const numbers = find_ids(frame, ids);
  const Survey all = survey(frame, numbers != nullptr, ranks);
  if (!all.has_ids)
  {
    notices.push_back(
      { where, "expected a column id to sort by, got none; the order is the file's" });
    return;
  }
  if (all.rows == 0)
  {
    return;
  }
  const RowOrder leave({ numbers, static_cast<std::size_t>(frame.rows) });
  if (ranks.size() == 1)
  {
    for_each_block(frame, all.point_width,
      [&](Block& block, std::size_t width) { leave.apply(block, width, executor); });
    return;
  }
  for (TableArray& array : frame.arrays)
  {
    if (array.info.type == ValueType::Text)
    {
      join_words(array, ranks, frame.rows, where);
    }
  }

  constexpr std::size_t id_width = sizeof(std::int64_t);
  Block sorted(static_cast<std::size_t>(frame.rows) * id_width);
  std::copy_n(numbers, frame.rows, static_cast<std::int64_t*>(sorted.data()));
  leave.apply(sorted, id_width, executor);
  const std::vector<std::int64_t> out = count_parts(all.rows, ids_in(sorted), ranks);
  const std::vector<std::int64_t> in = swap_numbers(out, ranks);
  frame.rows = sum_of(in);
  const auto trade_rows = [&](Block& block, std::size_t width)
  {
    Block came(static_cast<std::size_t>(frame.rows) * width, block.pool());
    ranks.exchange(static_cast<const char*>(block.data()), to_bytes(out, width),
      static_cast<char*>(came.data()), to_bytes(in, width));
    block = std::move(came);
  };
  trade_rows(sorted, id_width);
  const RowOrder arrive(ids_in(sorted));
  sorted = Block();
  const auto move_rows = [&](Block& block, std::size_t width)
  {
    leave.apply(block, width, executor);
    trade_rows(block, width);
    arrive.apply(block, width, executor);
  };
  for_each_block(frame, all.point_width, move_rows);
}
}

std::vector<std::int64_t> find_ids_at(const std::vector<std::int64_t>& places,
  std::span<const std::int64_t> sorted, Communicator& ranks)
{
  std::vector<std::int64_t> low(places.size(), std::numeric_limits<std::int64_t>::min());
  std::vector<std::int64_t> high(places.size(), std::numeric_limits<std::int64_t>::max());
  std::vector<std::int64_t> up_to(places.size());
  while (low != high)
  {
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const auto end =
        std::upper_bound(sorted.begin(), sorted.end(), std::midpoint(low[i], high[i]));
      up_to[i] = end - sorted.begin();
    }
    ranks.sum(up_to);
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      const std::int64_t middle = std::midpoint(low[i], high[i]);
      (up_to[i] > places[i] ? high[i] : low[i]) = up_to[i] > places[i] ? middle : middle + 1;
    }
  }
  return low;
}

void sort_by_id(Table& frame, const Block& ids, Communicator& ranks, Notices& notices,
  const Where& where, const Executor& executor)
{
  do_together(ranks, [&] { sort_together(frame, ids, ranks, notices, where, executor); });
}

void keep_rows(Table& frame, std::int64_t first, std::int64_t count)
{
  for_each_block(frame, point_width(frame),
    [&](Block& block, std::size_t width)
    {
      if (block.bytes() > 0)
      {
        auto* const data = static_cast<char*>(block.data());
        const std::size_t bytes = static_cast<std::size_t>(count) * width;
        std::memmove(data, data + static_cast<std::size_t>(first) * width, bytes);
        block.shrink(bytes);
      }
    });
  frame.rows = count;
}
}
