// SPDX-License-Identifier: BSD-3-Clause
#include "granular/sorting/sort_rows.h"

#include "granular/common/shares.h"
#include "granular/parallel/trade.h"
#include "granular/sorting/find_ids_at.h"
#include "granular/sorting/text_dictionary.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
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

void note_no_ids(Notices& notices, const Where& where)
{
  notices.push_back(
    { where, "expected a column id to sort by, got none; the order is the file's" });
}

/// Calls call(block, width) for all that has a value a row.
template <class Call>
void for_each_block(Table& frame, const Call& call)
{
  if (frame.rows > 0)
  {
    call(frame.points, frame.points.bytes() / static_cast<std::size_t>(frame.rows));
  }
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
  const std::size_t width =
    frame.rows > 0 ? frame.points.bytes() / static_cast<std::size_t>(frame.rows) : 0;
  Survey sum;
  bool lacking = false; // a rank with rows has no ids
  for (const Survey& own : gather(ranks, Survey{ frame.rows, width, has_ids }))
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
    note_no_ids(notices, where);
    return;
  }
  if (all.rows == 0)
  {
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
  const RowOrder leave(ids_in(sorted));
  leave.apply(sorted, id_width, executor);
  const std::vector<std::int64_t> out = count_parts(all.rows, ids_in(sorted), ranks);
  const std::vector<std::int64_t> in = swap_numbers(out, ranks);
  frame.rows = std::accumulate(in.begin(), in.end(), std::int64_t{ 0 });
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
  move_rows(frame.points, all.point_width);
  for (TableArray& array : frame.arrays)
  {
    move_rows(array.block, row_width(array));
  }
}
}

void sort_by_id(
  Table& frame, const Block& ids, Notices& notices, const Where& where, const Executor& executor)
{
  const std::int64_t* const numbers = find_ids(frame, ids);
  if (!numbers)
  {
    note_no_ids(notices, where);
    return;
  }
  const RowOrder order({ numbers, static_cast<std::size_t>(frame.rows) });
  for_each_block(
    frame, [&](Block& block, std::size_t width) { order.apply(block, width, executor); });
}

void sort_by_id(Table& frame, const Block& ids, Communicator& ranks, Notices& notices,
  const Where& where, const Executor& executor)
{
  if (ranks.size() == 1)
  {
    sort_by_id(frame, ids, notices, where, executor);
    return;
  }
  do_together(ranks, [&] { sort_together(frame, ids, ranks, notices, where, executor); });
}

void keep_rows(Table& frame, std::int64_t first, std::int64_t count)
{
  for_each_block(frame,
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
