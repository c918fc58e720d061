// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/fetch_particles.h"

#include "granular/local/id_finder.h"
#include "granular/parallel/trade.h"
#include "granular/particles/point_forms.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <utility>

namespace granular
{
namespace
{
using Numbers = std::vector<std::int64_t>;

/// The rank that knows who has an id. The hash table there uses the lower bits.
std::size_t keeper_of(std::int64_t id, std::size_t ranks) noexcept
{
  return (hash_of_id(id) >> 32) % ranks;
}

/// Things in the order of the ranks that they go to.
struct Sorted
{
  Numbers counts; ///< for each rank
  Numbers places; ///< of each, where it was before
};

/// Those of count things that have a rank; rank_of gives the number of ranks for one that has none.
template <class RankOf>
Sorted sort_by_rank(std::size_t count, std::size_t ranks, const RankOf& rank_of)
{
  Sorted sorted;
  sorted.counts.assign(ranks + 1, 0);
  for (std::size_t i = 0; i < count; ++i)
  {
    ++sorted.counts[rank_of(i)];
  }
  Numbers next(ranks + 1);
  std::exclusive_scan(sorted.counts.begin(), sorted.counts.end(), next.begin(), std::int64_t{ 0 });
  sorted.counts.pop_back();
  sorted.places.resize(static_cast<std::size_t>(next.back()));
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t rank = rank_of(i);
    if (rank < ranks)
    {
      sorted.places[static_cast<std::size_t>(next[rank]++)] = static_cast<std::int64_t>(i);
    }
  }
  return sorted;
}

Numbers pick(std::span<const std::int64_t> from, const Numbers& places)
{
  Numbers picked(places.size());
  std::ranges::transform(places, picked.begin(),
    [&](std::int64_t place) { return from[static_cast<std::size_t>(place)]; });
  return picked;
}

/// The ids of both ends, each once, in the order in which they first occur.
Numbers find_distinct(std::span<const std::int64_t> id1, std::span<const std::int64_t> id2)
{
  Numbers distinct;
  IdTable table;
  for (std::size_t i = 0; i < id1.size(); ++i)
  {
    const std::size_t soon = std::min(i + 8, id1.size() - 1);
    table.prefetch(id1[soon]);
    table.prefetch(id2[soon]);
    for (const std::int64_t id : { id1[i], id2[i] })
    {
      if (table.add(id, 0))
      {
        distinct.push_back(id);
      }
    }
  }
  return distinct;
}

/// Where a particle is; rank -1: nowhere.
struct Home
{
  std::int64_t rank = -1;
  std::int64_t row = 0;
};

/// The ids that belong to this rank, with their homes.
class Directory
{
public:
  /// Collective.
  Directory(const OwnParticles& own, Communicator& ranks)
  {
    const auto size = static_cast<std::size_t>(ranks.size());
    const Sorted sorted = sort_by_rank(own.ids.size(), size,
      [&](std::size_t row)
      {
        const bool left_out = FrameView::is_duplicate(own.ghosts, static_cast<std::int64_t>(row));
        return left_out ? size : keeper_of(own.ids[row], size);
      });
    const Numbers come = swap_numbers(sorted.counts, ranks);
    finder_ = IdFinder(trade(pick(own.ids, sorted.places), sorted.counts, come, ranks));
    rows_ = trade(sorted.places, sorted.counts, come, ranks);
    ends_.resize(size);
    std::inclusive_scan(come.begin(), come.end(), ends_.begin());
  }

  std::int64_t repeated() const noexcept { return finder_.repeated(); }

  std::vector<Home> find(const Numbers& ids) const
  {
    Numbers places(ids.size());
    finder_.find(ids, places.data());
    std::vector<Home> homes(ids.size());
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      if (places[i] != IdFinder::nowhere)
      {
        homes[i] = { std::ranges::upper_bound(ends_, places[i]) - ends_.begin(),
          rows_[static_cast<std::size_t>(places[i])] };
      }
    }
    return homes;
  }

private:
  IdFinder finder_;
  Numbers rows_; ///< of each id, by rank
  Numbers ends_; ///< behind those of each rank
};

/// Points and arrays of a particle, one after the other.
std::size_t width_of(const ParticleValues& values)
{
  return std::accumulate(values.arrays.begin(), values.arrays.end(), std::size_t{ 3 },
    [](std::size_t sum, const ArrayView& array) { return sum + array.components.size(); });
}

std::vector<double> pack(const ParticleValues& values, const Numbers& rows)
{
  constexpr std::size_t some = 1024; // rows at once, that stay in the cache
  std::array<double, some> numbers;
  const std::size_t width = width_of(values);
  std::vector<double> packed(rows.size() * width);
  for (std::size_t first = 0; first < rows.size(); first += some)
  {
    const auto now = std::span(rows).subspan(first, std::min(some, rows.size() - first));
    double* to = packed.data() + first * width;
    for (std::size_t i = 0; i < now.size(); ++i)
    {
      std::copy_n(values.points + now[i] * values.point_step, 3, to + i * width);
    }
    to += 3;
    for (const ArrayView& array : values.arrays)
    {
      for (int component = 0; component < array.size(); ++component)
      {
        load_numbers(component_of(array, component), now, numbers.data());
        for (std::size_t i = 0; i < now.size(); ++i)
        {
          to[i * width] = numbers[i];
        }
        ++to;
      }
    }
  }
  return packed;
}

/// Lets points and arrays show what came.
void view_packed(ParticleValues& values, std::size_t width)
{
  const double* next = values.own.data();
  values.points = next;
  values.point_step = static_cast<std::int64_t>(width);
  next += 3;
  for (ArrayView& array : values.arrays)
  {
    array.type = ValueType::Float64;
    array.step = values.point_step;
    for (const void*& component : array.components)
    {
      component = next++;
    }
  }
}
}

FetchedParticles fetch_particles(const OwnParticles& own, std::span<const std::int64_t> id1,
  std::span<const std::int64_t> id2, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      const auto size = static_cast<std::size_t>(ranks.size());
      const Directory directory(own, ranks);
      const Numbers wanted = find_distinct(id1, id2);
      const Sorted questions = sort_by_rank(
        wanted.size(), size, [&](std::size_t i) { return keeper_of(wanted[i], size); });
      const Numbers asked = pick(wanted, questions.places);
      const Numbers come = swap_numbers(questions.counts, ranks);
      const Numbers told = trade(asked, questions.counts, come, ranks);
      const std::vector<Home> homes = trade(directory.find(told), come, questions.counts, ranks);

      FetchedParticles fetched;
      const Sorted requests = sort_by_rank(homes.size(), size,
        [&](std::size_t i)
        { return homes[i].rank < 0 ? size : static_cast<std::size_t>(homes[i].rank); });
      fetched.ids = pick(asked, requests.places);
      Numbers rows(requests.places.size());
      std::ranges::transform(requests.places, rows.begin(),
        [&](std::int64_t place) { return homes[static_cast<std::size_t>(place)].row; });
      fetched.values.arrays = own.values.arrays;
      const Numbers wanted_here = swap_numbers(requests.counts, ranks);
      rows = trade(rows, requests.counts, wanted_here, ranks);
      const std::size_t width = width_of(own.values);
      fetched.values.own =
        trade(pack(own.values, rows), wanted_here, requests.counts, ranks, width);
      view_packed(fetched.values, width);
      fetched.repeated = directory.repeated();
      return fetched;
    });
}
}
