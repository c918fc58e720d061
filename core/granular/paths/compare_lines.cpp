// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/compare_lines.h"

#include "granular/common/error.h"
#include "granular/local/id_finder.h"
#include "granular/parallel/by_rank.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <string>

namespace granular
{
namespace
{
using Numbers = std::vector<std::int64_t>;

/// The lower id, the higher id: equal for lines that are the same.
using Key = std::array<std::int64_t, 2>;

std::vector<Key> keys_of(const LineEnds& lines)
{
  if (lines.id2.size() != lines.id1.size())
  {
    throw Error("expected as many ids of second ends as of first ends, " +
      std::to_string(lines.id1.size()) + ", got " + std::to_string(lines.id2.size()));
  }
  std::vector<Key> keys(lines.id1.size());
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    const auto [low, high] = std::minmax(lines.id1[i], lines.id2[i]);
    keys[i] = { low, high };
  }
  return keys;
}

/// The rank that compares lines with this key.
std::size_t keeper_of(const Key& key, std::size_t ranks) noexcept
{
  std::uint64_t hash = 0;
  for (const std::int64_t number : key)
  {
    hash = hash_of_id(static_cast<std::int64_t>(hash * 31 + static_cast<std::uint64_t>(number)));
  }
  return (hash >> 32) % ranks;
}

/// The lines of a frame that this rank compares, by rank and row, and how their changes come back.
class KeptLines
{
public:
  /// Collective.
  KeptLines(const LineEnds& lines, Communicator& ranks)
  {
    const auto size = static_cast<std::size_t>(ranks.size());
    const std::vector<Key> keys = keys_of(lines);
    sent_ =
      sort_by_rank(keys.size(), size, [&](std::size_t i) { return keeper_of(keys[i], size); });
    come_ = swap_numbers(sent_.counts, ranks);
    keys_ = trade(pick(keys, sent_.places), sent_.counts, come_, ranks);
  }

  const Key& key(std::size_t place) const noexcept { return keys_[place]; }

  /// Places in the order of the keys; those of equal keys in theirs.
  std::vector<std::size_t> order() const
  {
    std::vector<std::size_t> places(keys_.size());
    std::iota(places.begin(), places.end(), std::size_t{ 0 });
    std::ranges::stable_sort(
      places, {}, [&](std::size_t place) -> const Key& { return keys_[place]; });
    return places;
  }

  /// Returns the changes of the lines of this rank, given those of the lines compared here. Collective.
  std::vector<Change> send_back(const std::vector<Change>& changes, Communicator& ranks) const
  {
    const std::vector<Change> answers = trade(changes, come_, sent_.counts, ranks);
    std::vector<Change> own(answers.size());
    for (std::size_t i = 0; i < answers.size(); ++i)
    {
      own[static_cast<std::size_t>(sent_.places[i])] = answers[i];
    }
    return own;
  }

  std::size_t size() const noexcept { return keys_.size(); }

private:
  ByRank sent_;
  Numbers come_;
  std::vector<Key> keys_;
};
}

LineChanges compare_lines(const LineEnds& current, const LineEnds& reference, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      const KeptLines now(current, ranks);
      const KeptLines before(reference, ranks);
      LineChanges kept = { std::vector(now.size(), Change::New),
        std::vector(before.size(), Change::Lost) };
      const std::vector<std::size_t> places = before.order();
      auto next = places.begin();
      for (const std::size_t place : now.order())
      {
        while (next != places.end() && before.key(*next) < now.key(place))
        {
          ++next;
        }
        if (next != places.end() && before.key(*next) == now.key(place))
        {
          kept.current[place] = Change::Kept;
          kept.reference[*next++] = Change::Kept;
        }
      }
      return LineChanges{ now.send_back(kept.current, ranks),
        before.send_back(kept.reference, ranks) };
    });
}
}
