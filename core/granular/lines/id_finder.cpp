// SPDX-License-Identifier: BSD-3-Clause
#include "granular/lines/id_finder.h"

#include "granular/common/error.h"
#include "granular/parallel/trade.h"
#include "granular/particles/frame_view.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

namespace granular
{
namespace
{
using Numbers = std::vector<std::int64_t>;

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

/// The rank that keeps the home of an id. The hash table there uses the lower bits.
std::size_t keeper_of(std::int64_t id, std::size_t ranks) noexcept
{
  return (hash_of_id(id) >> 32) % ranks;
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

IdDirectory::IdDirectory(
  std::span<const std::int64_t> ids, const unsigned char* ghosts, Communicator& ranks)
{
  const auto size = static_cast<std::size_t>(ranks.size());
  const ByRank sorted = sort_by_rank(ids.size(), size,
    [&](std::size_t row)
    {
      const bool left_out = FrameView::is_duplicate(ghosts, static_cast<std::int64_t>(row));
      return left_out ? size : keeper_of(ids[row], size);
    });
  const Numbers come = swap_numbers(sorted.counts, ranks);
  ids_ = trade(pick(ids, sorted.places), sorted.counts, come, ranks);
  finder_ = IdFinder(ids_);
  rows_ = trade(sorted.places, sorted.counts, come, ranks);
  ends_.resize(size);
  std::inclusive_scan(come.begin(), come.end(), ends_.begin());
  const Numbers rows = gather(ranks, static_cast<std::int64_t>(ids.size()));
  begins_.resize(size);
  std::exclusive_scan(rows.begin(), rows.end(), begins_.begin(), std::int64_t{ 0 });
}

ParticleHome IdDirectory::home(std::int64_t place) const
{
  return { std::ranges::upper_bound(ends_, place) - ends_.begin(),
    rows_[static_cast<std::size_t>(place)] };
}

std::optional<RepeatedId> IdDirectory::find_repeated(Communicator& ranks) const
{
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  RepeatedId own{ .second_row = none };
  const auto row_of = [&](std::int64_t place)
  {
    const ParticleHome at = this->home(place);
    return begins_[static_cast<std::size_t>(at.rank)] + at.row;
  };
  for (std::size_t i = 0; finder_.repeated() > 0 && i < ids_.size(); ++i)
  {
    std::int64_t first = IdFinder::nowhere;
    finder_.find({ &ids_[i], 1 }, &first);
    const auto place = static_cast<std::int64_t>(i);
    if (first != place && row_of(place) < own.second_row)
    {
      own = { ids_[i], row_of(first), row_of(place) };
    }
  }
  const std::vector<RepeatedId> all = gather(ranks, own);
  const RepeatedId& lowest = *std::ranges::min_element(all, {}, &RepeatedId::second_row);
  return lowest.second_row == none ? std::nullopt : std::optional(lowest);
}

void IdDirectory::expect_distinct(const std::string& whose, Communicator& ranks) const
{
  if (const std::optional<RepeatedId> found = this->find_repeated(ranks))
  {
    throw Error("expected each id once among the " + whose + ", got id " +
      std::to_string(found->id) + " in rows " + std::to_string(found->first_row) + " and " +
      std::to_string(found->second_row) + " (the first is 0)");
  }
}

std::vector<ParticleHome> IdDirectory::find_kept(const Numbers& ids) const
{
  Numbers places(ids.size());
  finder_.find(ids, places.data());
  std::vector<ParticleHome> homes(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i)
  {
    homes[i] = places[i] == IdFinder::nowhere ? ParticleHome{} : this->home(places[i]);
  }
  return homes;
}

std::vector<ParticleHome> IdDirectory::find(
  std::span<const std::int64_t> ids, Communicator& ranks) const
{
  const auto size = static_cast<std::size_t>(ranks.size());
  const ByRank questions =
    sort_by_rank(ids.size(), size, [&](std::size_t i) { return keeper_of(ids[i], size); });
  const Numbers come = swap_numbers(questions.counts, ranks);
  const Numbers told = trade(pick(ids, questions.places), questions.counts, come, ranks);
  const std::vector<ParticleHome> answers =
    trade(this->find_kept(told), come, questions.counts, ranks);
  std::vector<ParticleHome> homes(ids.size());
  for (std::size_t i = 0; i < answers.size(); ++i)
  {
    homes[static_cast<std::size_t>(questions.places[i])] = answers[i];
  }
  return homes;
}
}
