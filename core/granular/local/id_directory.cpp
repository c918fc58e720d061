// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/id_directory.h"

#include "granular/common/error.h"
#include "granular/parallel/by_rank.h"
#include "granular/parallel/gather.h"
#include "granular/parallel/trade.h"
#include "granular/particles/frame_view.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>

namespace granular
{
namespace
{
using Numbers = std::vector<std::int64_t>;

/// The rank that keeps the home of an id. The hash table there uses the lower bits.
std::size_t keeper_of(std::int64_t id, std::size_t ranks) noexcept
{
  return (hash_of_id(id) >> 32) % ranks;
}
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
