// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/id_finder.h"

#include "granular/particles/frame_view.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace granular
{
namespace
{
constexpr std::size_t ahead = 16; // ids whose slots are being brought into the cache

/// From one id to another that is not less; a difference of any two fits.
std::uint64_t distance(std::int64_t from, std::int64_t to) noexcept
{
  return static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
}

/// Those that count, not knowing their place.
struct Range
{
  std::int64_t lowest = std::numeric_limits<std::int64_t>::max();
  std::int64_t highest = std::numeric_limits<std::int64_t>::min();
  std::size_t count = 0;
};

Range range_of(std::span<const std::int64_t> ids, const unsigned char* ghosts) noexcept
{
  Range range;
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    if (!FrameView::is_duplicate(ghosts, static_cast<std::int64_t>(i)))
    {
      range.lowest = std::min(range.lowest, ids[i]);
      range.highest = std::max(range.highest, ids[i]);
      ++range.count;
    }
  }
  return range;
}
}

IdTable::IdTable(std::size_t ids)
  : slots_(std::bit_ceil(2 * ids))
  , mask_(slots_.size() - 1)
{
}

bool IdTable::add(std::int64_t id, std::int64_t place)
{
  if (2 * (taken_ + 1) > slots_.size())
  {
    this->grow();
  }
  auto& slot = const_cast<Slot&>(this->slot(id));
  if (slot.place != nowhere)
  {
    return false;
  }
  slot = { id, place };
  ++taken_;
  return true;
}

void IdTable::grow()
{
  IdTable larger(std::max<std::size_t>(slots_.size(), 8));
  for (const Slot& slot : slots_)
  {
    if (slot.place != nowhere)
    {
      larger.add(slot.id, slot.place);
    }
  }
  *this = std::move(larger);
}

IdFinder::IdFinder(std::span<const std::int64_t> ids, const unsigned char* ghosts)
{
  const Range range = range_of(ids, ghosts);
  if (range.count == 0)
  {
    return;
  }
  const std::uint64_t last = distance(range.lowest, range.highest);
  // places of 32 bits: twice as many fit into the caches, and no rank has more particles
  if (last < 4 * range.count + 64 && ids.size() <= std::numeric_limits<std::int32_t>::max())
  {
    lowest_ = range.lowest;
    direct_.assign(last + 1, nowhere);
  }
  else
  {
    table_ = IdTable(range.count);
  }
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    const auto place = static_cast<std::int64_t>(i);
    if (FrameView::is_duplicate(ghosts, place))
    {
      continue;
    }
    if (direct_.empty())
    {
      table_.prefetch(ids[std::min(i + ahead, ids.size() - 1)]);
      repeated_ += table_.add(ids[i], place) ? 0 : 1;
      continue;
    }
    std::int32_t& found = direct_[distance(lowest_, ids[i])];
    repeated_ += found == nowhere ? 0 : 1;
    found = found == nowhere ? static_cast<std::int32_t>(place) : found;
  }
}

void IdFinder::find(std::span<const std::int64_t> ids, std::int64_t* places) const noexcept
{
  if (!direct_.empty())
  {
    std::ranges::transform(ids, places,
      [&](std::int64_t id)
      {
        const std::uint64_t at = distance(lowest_, id); // below the lowest: more than there are
        return at < direct_.size() ? std::int64_t{ direct_[at] } : nowhere;
      });
    return;
  }
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    table_.prefetch(ids[std::min(i + ahead, ids.size() - 1)]);
    places[i] = table_.find(ids[i]);
  }
}

std::vector<std::int64_t> distinct_ids(
  std::span<const std::int64_t> first, std::span<const std::int64_t> second)
{
  std::vector<std::int64_t> distinct;
  IdTable table;
  for (std::size_t i = 0; i < first.size(); ++i)
  {
    const std::size_t soon = std::min(i + 8, first.size() - 1);
    table.prefetch(first[soon]);
    table.prefetch(second[soon]);
    for (const std::int64_t id : { first[i], second[i] })
    {
      if (table.add(id, 0))
      {
        distinct.push_back(id);
      }
    }
  }
  return distinct;
}
}
