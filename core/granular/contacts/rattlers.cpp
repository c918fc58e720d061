// SPDX-License-Identifier: BSD-3-Clause
#include "granular/contacts/find_ends.h"

#include "granular/parallel/trade.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace granular
{
namespace
{
using Numbers = std::vector<std::int64_t>;

/// Things in the order of what they belong to.
class Groups
{
public:
  /// owners: of each thing, from 0 to count - 1, or -1: of none.
  Groups(std::span<const std::int64_t> owners, std::size_t count)
    : things_(sort_by_rank(owners.size(), count,
        [&](std::size_t i) { return std::min(static_cast<std::size_t>(owners[i]), count); }))
    , ends_(count)
  {
    std::partial_sum(things_.counts.begin(), things_.counts.end(), ends_.begin());
  }

  std::span<const std::int64_t> of(std::int64_t owner) const noexcept
  {
    const auto at = static_cast<std::size_t>(owner);
    const auto size = static_cast<std::size_t>(things_.counts[at]);
    return std::span(things_.places).subspan(static_cast<std::size_t>(ends_[at]) - size, size);
  }

private:
  ByRank things_;
  Numbers ends_;
};

/// Sends each number to its rank. Returns those that come, and how many from each rank.
std::pair<Numbers, Numbers> send(const Numbers& numbers, const Numbers& to, Communicator& ranks)
{
  const auto size = static_cast<std::size_t>(ranks.size());
  const ByRank sorted = sort_by_rank(
    numbers.size(), size, [&](std::size_t i) { return static_cast<std::size_t>(to[i]); });
  const Numbers counts = swap_numbers(sorted.counts, ranks);
  return { trade(pick(numbers, sorted.places), sorted.counts, counts, ranks), counts };
}

/// The ends of all pairs one after the other.
std::span<const std::int64_t> ends_of(std::span<const ContactPair> pairs) noexcept
{
  return { pairs.empty() ? nullptr : pairs.front().data(), 2 * pairs.size() };
}

/// Ranks with contacts of the particles of this rank: their numbers, and places in their lists.
struct Listeners
{
  Numbers rows; ///< of the particles
  Numbers ranks;
  Numbers places;
};

Listeners find_listeners(std::span<const ParticleHome> homes, Communicator& ranks)
{
  Numbers rows;
  Numbers to;
  Numbers places;
  for (std::size_t i = 0; i < homes.size(); ++i)
  {
    if (homes[i].rank >= 0)
    {
      rows.push_back(homes[i].row);
      to.push_back(homes[i].rank);
      places.push_back(static_cast<std::int64_t>(i));
    }
  }
  Listeners listeners;
  Numbers counts;
  std::tie(listeners.rows, counts) = send(rows, to, ranks);
  listeners.places = send(places, to, ranks).first;
  for (std::size_t rank = 0; rank < counts.size(); ++rank)
  {
    listeners.ranks.insert(listeners.ranks.end(), static_cast<std::size_t>(counts[rank]),
      static_cast<std::int64_t>(rank));
  }
  return listeners;
}
}

Rattlers find_rattlers(std::span<const ParticleHome> homes, std::span<const ContactPair> pairs,
  std::span<const std::int32_t> coordination, std::int32_t least, Communicator& ranks,
  Progress& progress)
{
  return do_together(ranks,
    [&]
    {
      Rattlers rattlers;
      rattlers.are.resize(coordination.size());
      rattlers.contacts.assign(coordination.begin(), coordination.end());
      const Listeners listeners = find_listeners(homes, ranks);
      const Groups listening(listeners.rows, coordination.size());
      const Groups contacts(ends_of(pairs), homes.size());
      std::vector<bool> gone(pairs.size());
      Numbers found; // rattlers of this turn
      for (std::size_t row = 0; row < coordination.size(); ++row)
      {
        if (coordination[row] < least)
        {
          found.push_back(static_cast<std::int64_t>(row));
        }
      }
      std::int64_t all = 1;
      while (all > 0)
      {
        progress.step(0);
        Numbers places;
        Numbers to;
        for (const std::int64_t row : found)
        {
          rattlers.are[static_cast<std::size_t>(row)] = 1;
          rattlers.contacts[static_cast<std::size_t>(row)] = 0;
          for (const std::int64_t listener : listening.of(row))
          {
            places.push_back(listeners.places[static_cast<std::size_t>(listener)]);
            to.push_back(listeners.ranks[static_cast<std::size_t>(listener)]);
          }
        }
        Numbers rows;
        Numbers homes_of_rows;
        for (const std::int64_t place : send(places, to, ranks).first)
        {
          for (const std::int64_t end : contacts.of(place))
          {
            const auto pair = static_cast<std::size_t>(end / 2);
            const std::int64_t other = pairs[pair][static_cast<std::size_t>(1 - end % 2)];
            if (!gone[pair] && other >= 0)
            {
              rows.push_back(homes[static_cast<std::size_t>(other)].row);
              homes_of_rows.push_back(homes[static_cast<std::size_t>(other)].rank);
            }
            gone[pair] = true;
          }
        }
        found.clear();
        for (const std::int64_t row : send(rows, homes_of_rows, ranks).first)
        {
          const auto at = static_cast<std::size_t>(row);
          if (rattlers.are[at] == 0 && --rattlers.contacts[at] == least - 1)
          {
            found.push_back(row);
          }
        }
        all = static_cast<std::int64_t>(found.size());
        ranks.sum({ &all, 1 });
      }
      return rattlers;
    });
}
}
