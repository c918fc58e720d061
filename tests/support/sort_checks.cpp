// SPDX-License-Identifier: BSD-3-Clause
#include "sort_checks.h"

#include "granular/sorting/sort_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <random>

namespace
{
using granular::Block;
using granular::ColumnRole;
using granular::Table;
using granular::TableArray;
using granular::ValueType;

constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();

const std::map<std::string, std::function<void(Ids&)>>& makers()
{
  // shuffled by a rule of our own: those of the library may differ between its versions
  static const auto shuffle = [](Ids& ids)
  {
    std::mt19937_64 random(ids.size());
    for (std::size_t i = ids.size(); i > 1; --i)
    {
      std::swap(ids[i - 1], ids[random() % i]);
    }
  };
  static const auto fill = [](Ids& ids, const std::function<std::int64_t(std::uint64_t)>& id)
  {
    std::mt19937_64 random(7);
    std::generate(ids.begin(), ids.end(), [&] { return id(random()); });
  };
  static const std::map<std::string, std::function<void(Ids&)>> all = {
    { "sorted", [](Ids& ids) { std::iota(ids.begin(), ids.end(), 1); } },
    { "reversed", [](Ids& ids) { std::iota(ids.rbegin(), ids.rend(), -5); } },
    { "shuffled",
      [](Ids& ids)
      {
        std::iota(ids.begin(), ids.end(), 1);
        shuffle(ids);
      } },
    { "repeated",
      [](Ids& ids) { fill(ids, [&](auto any) { return any % (ids.size() / 4 + 1); }); } },
    { "equal", [](Ids& ids) { std::fill(ids.begin(), ids.end(), 42); } },
    { "two", [](Ids& ids) { fill(ids, [](auto any) { return any % 2; }); } },
    { "mostly one", [](Ids& ids) { fill(ids, [](auto any) { return any % 20 ? 3 : any % 7; }); } },
    { "any bits", [](Ids& ids) { fill(ids, [](auto any) { return any; }); } },
    { "ends", [](Ids& ids) { fill(ids, [](auto any) { return any % 2 ? lowest : highest; }); } },
    { "near the ends",
      [](Ids& ids)
      {
        fill(ids,
          [](auto any)
          {
            const auto off = static_cast<std::int64_t>(any % 5);
            return any % 3 == 0 ? lowest + off : any % 3 == 1 ? highest - off : 0;
          });
      } },
    { "all at the low end", [](Ids& ids) { std::fill(ids.begin(), ids.end(), lowest); } },
    { "all at the high end", [](Ids& ids) { std::fill(ids.begin(), ids.end(), highest); } },
  };
  return all;
}

/// Any bits, of a row of the whole frame: also such as make no number.
std::uint64_t bits(std::uint64_t row, std::uint64_t what)
{
  std::uint64_t value = (row * 8 + what + 1) * 0x9e3779b97f4a7c15u;
  value ^= value >> 29;
  return value * 0xbf58476d1ce4e5b9u;
}

TableArray make_array(const std::string& name, ValueType type, std::size_t components,
  std::size_t rows, ColumnRole role = ColumnRole::Other)
{
  TableArray array;
  array.info.name = name;
  array.info.type = type;
  array.info.role = role;
  array.info.columns.resize(components);
  array.block = Block(rows * components * granular::size_of(type));
  return array;
}

/// Fills the rows of a block from their numbers in the whole.
void fill(Block& block, const std::vector<std::size_t>& numbers, std::uint64_t what)
{
  if (numbers.empty())
  {
    return;
  }
  const std::size_t width = block.bytes() / numbers.size();
  auto* to = static_cast<char*>(block.data());
  for (const std::size_t number : numbers)
  {
    for (std::size_t done = 0; done < width; done += 4, to += 4)
    {
      const std::uint64_t value = bits(number * 8 + done / 4, what);
      std::memcpy(to, &value, 4);
    }
  }
}

/// Which of a few words a row has.
std::size_t word_of(std::size_t number)
{
  return bits(number, 99) % 13;
}

/// Rows of the whole by their numbers; words as they first occur in the rows `known` of the whole.
Table make_rows(const Ids& ids, const std::vector<std::size_t>& numbers,
  const std::vector<std::size_t>& known, bool with_id_array, bool single_precision)
{
  const std::size_t rows = numbers.size();
  Table frame;
  frame.rows = static_cast<std::int64_t>(rows);
  frame.points = Block(rows * (single_precision ? 12 : 24));
  fill(frame.points, numbers, 0);
  frame.arrays.push_back(make_array("type", ValueType::Int32, 1, rows));
  frame.arrays.push_back(make_array("f", ValueType::Float64, 3, rows));
  frame.arrays.push_back(make_array("pair", ValueType::Float64, 2, rows));
  for (std::size_t i = 0; i < frame.arrays.size(); ++i)
  {
    fill(frame.arrays[i].block, numbers, i + 1);
  }
  if (with_id_array)
  {
    frame.arrays.push_back(make_array("id", ValueType::Int64, 1, rows, ColumnRole::Id));
    std::transform(numbers.begin(), numbers.end(),
      static_cast<std::int64_t*>(frame.arrays.back().block.data()),
      [&](std::size_t number) { return ids[number]; });
  }
  TableArray texts = make_array("element", ValueType::Text, 1, rows);
  std::array<std::int32_t, 13> index;
  index.fill(-1);
  for (const std::size_t number : known)
  {
    if (const std::size_t word = word_of(number); index[word] < 0)
    {
      index[word] = static_cast<std::int32_t>(texts.words.size());
      texts.words.push_back("w" + std::to_string(word));
    }
  }
  std::transform(numbers.begin(), numbers.end(), static_cast<std::int32_t*>(texts.block.data()),
    [&](std::size_t number) { return index[word_of(number)]; });
  frame.arrays.push_back(std::move(texts));
  return frame;
}

std::vector<std::size_t> numbers_from(std::size_t first, std::size_t last)
{
  std::vector<std::size_t> numbers(last - first);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

/// How many of the rows each rank has at first.
using Spread = std::function<std::size_t(std::size_t rows, std::size_t rank, std::size_t ranks)>;

const std::map<std::string, Spread>& spreads()
{
  static const std::map<std::string, Spread> all = {
    { "even",
      [](auto rows, auto rank, auto ranks)
      { return rows * (rank + 1) / ranks - rows * rank / ranks; } },
    { "all on the first", [](auto rows, auto rank, auto) { return rank == 0 ? rows : 0; } },
    { "all on the last",
      [](auto rows, auto rank, auto ranks) { return rank + 1 == ranks ? rows : 0; } },
    { "skewed", // half of the rows on rank 1, a quarter on 2, ..., and what is left on 0
      [](auto rows, auto rank, auto ranks)
      {
        const auto of = [&](std::size_t one) { return rows >> one; };
        std::size_t others = 0;
        for (std::size_t one = 1; one < ranks; ++one)
        {
          others += of(one);
        }
        return rank == 0 ? rows - others : of(rank);
      } },
  };
  return all;
}

void check(granular::Communicator& ranks, const Ids& ids, const Spread& spread, bool with_id_array,
  bool single_precision)
{
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const auto size = static_cast<std::size_t>(ranks.size());
  std::size_t first = 0;
  for (std::size_t other = 0; other < rank; ++other)
  {
    first += spread(ids.size(), other, size);
  }
  const std::size_t last = first + spread(ids.size(), rank, size);
  auto [frame, own_ids] = make_frame(ids, first, last, with_id_array, single_precision);
  granular::Notices notices;
  sort_by_id(frame, own_ids, ranks, notices, {}, granular::Executor(1 + ranks.rank() % 2));
  EXPECT_TRUE(notices.empty());
  const Table expected = sorted_frame(
    ids, ids.size() * rank / size, ids.size() * (rank + 1) / size, with_id_array, single_precision);
  EXPECT_EQ(frame.rows, expected.rows);
  EXPECT_TRUE(bytes_of(frame) == bytes_of(expected));
}
}

const std::vector<std::string>& arrangements()
{
  static const std::vector<std::string> names = []
  {
    std::vector<std::string> all;
    for (const auto& [name, maker] : makers())
    {
      all.push_back(name);
    }
    return all;
  }();
  return names;
}

Ids make_ids(const std::string& arrangement, std::size_t count)
{
  Ids ids(count);
  makers().at(arrangement)(ids);
  return ids;
}

MadeFrame make_frame(
  const Ids& ids, std::size_t first, std::size_t last, bool with_id_array, bool single_precision)
{
  const std::vector<std::size_t> numbers = numbers_from(first, last);
  MadeFrame made = { make_rows(ids, numbers, numbers, with_id_array, single_precision), {} };
  if (!with_id_array)
  {
    made.ids = Block((last - first) * sizeof(std::int64_t));
    std::copy_n(ids.data() + first, last - first, static_cast<std::int64_t*>(made.ids.data()));
  }
  return made;
}

std::string bytes_of(const Table& frame)
{
  const auto content = [](const Block& block)
  { return std::string(static_cast<const char*>(block.data()), block.bytes()); };
  std::string bytes = content(frame.points);
  for (const TableArray& array : frame.arrays)
  {
    bytes += "\n" + array.info.name + "\n" + content(array.block);
    for (const std::string& word : array.words)
    {
      bytes += " " + word;
    }
  }
  return bytes;
}

Table sorted_frame(
  const Ids& ids, std::size_t first, std::size_t last, bool with_id_array, bool single_precision)
{
  const std::vector<std::size_t> all = numbers_from(0, ids.size());
  std::vector<std::size_t> numbers = all;
  std::stable_sort(
    numbers.begin(), numbers.end(), [&](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
  const auto at = [&](std::size_t place)
  { return numbers.begin() + static_cast<std::ptrdiff_t>(place); };
  return make_rows(ids, { at(first), at(last) }, all, with_id_array, single_precision);
}

void check_sort_by_id(granular::Communicator& ranks)
{
  constexpr std::size_t sizes[] = { 0, 1, 2, 4, 7, 100, 301 };
  std::size_t turn = 0; // any two of arrangement, spread and size together
  bool flag = false;    // ids as an array or not, and both precisions, in turns
  for (const std::string& arrangement : arrangements())
  {
    for (const auto& [name, spread] : spreads())
    {
      for (int i = 0; i < 2; ++i)
      {
        const std::size_t rows = sizes[turn++ % std::size(sizes)];
        SCOPED_TRACE(arrangement + ", " + name + ", " + std::to_string(rows));
        check(ranks, make_ids(arrangement, rows), spread, flag, !flag);
        flag = !flag;
      }
      flag = !flag;
    }
  }
}

void check_without_ids(granular::Communicator& ranks)
{
  // none has ids; or all but one that has rows
  for (const int lacking : { -1, ranks.size() - 1 })
  {
    const Ids ids = make_ids("reversed", 10);
    auto [frame, own_ids] = make_frame(ids, 0, 10, false);
    const std::string before = bytes_of(frame);
    if (lacking < 0 || ranks.rank() == lacking)
    {
      own_ids = Block();
    }
    granular::Notices notices;
    sort_by_id(frame, own_ids, ranks, notices, { "a.dump", 3 });
    EXPECT_EQ(bytes_of(frame), before);
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_EQ(to_string(notices[0]),
      "a.dump:3: expected a column id to sort by, got none; the order is the file's");
  }
}
