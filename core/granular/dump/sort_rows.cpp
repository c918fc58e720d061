// SPDX-License-Identifier: BSD-3-Clause
#include "granular/dump/sort_rows.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace granular
{
namespace
{
struct Place
{
  std::int64_t id;
  std::size_t row;

  auto operator<=>(const Place&) const = default; // rows differ: the order is that of a stable sort
};

const std::int64_t* find_ids(const DumpFrame& frame, const Block& ids)
{
  for (const DumpArray& array : frame.arrays)
  {
    if (array.info.role == ColumnRole::Id && array.info.type == ValueType::Int64)
    {
      return static_cast<const std::int64_t*>(array.block.data());
    }
  }
  return static_cast<const std::int64_t*>(ids.data());
}

void permute(Block& block, const std::vector<Place>& order)
{
  if (order.empty() || block.bytes() == 0)
  {
    return;
  }
  const std::size_t width = block.bytes() / order.size();
  Block sorted(block.bytes());
  const char* const from = static_cast<const char*>(block.data());
  char* to = static_cast<char*>(sorted.data());
  for (const Place& place : order)
  {
    std::memcpy(to, from + place.row * width, width);
    to += width;
  }
  block = std::move(sorted);
}
}

void sort_by_id(DumpFrame& frame, const Block& ids, Notices& notices, const Where& where)
{
  const std::int64_t* const numbers = find_ids(frame, ids);
  if (!numbers)
  {
    notices.push_back(
      { where, "expected a column id to sort by, got none; the order is the file's" });
    return;
  }
  std::vector<Place> order;
  order.reserve(static_cast<std::size_t>(frame.rows));
  for (std::size_t row = 0; row < static_cast<std::size_t>(frame.rows); ++row)
  {
    order.push_back({ numbers[row], row });
  }
  if (std::is_sorted(order.begin(), order.end()))
  {
    return;
  }
  std::sort(order.begin(), order.end());
  permute(frame.points, order);
  for (DumpArray& array : frame.arrays)
  {
    permute(array.block, order);
  }
}
}
