// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/compare_particles.h"

#include "granular/common/error.h"
#include "granular/lines/id_finder.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

namespace granular
{
namespace
{
/// A line where it is compared.
struct Line
{
  std::array<std::int64_t, 2>
    ids;                     ///< the lower one, the higher one: equal for lines that are the same
  std::int64_t is_reference; ///< 0: of the current frame
  std::int64_t place = 0;    ///< among the lines that this rank compares

  auto operator<=>(const Line&) const = default;
};

void add_lines(const LineEnds& ends, bool is_reference, std::vector<Line>& lines)
{
  if (ends.id2.size() != ends.id1.size())
  {
    throw Error("expected as many ids of second ends as of first ends, " +
      std::to_string(ends.id1.size()) + ", got " + std::to_string(ends.id2.size()));
  }
  for (std::size_t i = 0; i < ends.id1.size(); ++i)
  {
    const auto [low, high] = std::minmax(ends.id1[i], ends.id2[i]);
    lines.push_back({ { low, high }, is_reference ? 1 : 0 });
  }
}

/// The rank that compares a line.
std::size_t keeper_of(const Line& line, std::size_t ranks) noexcept
{
  std::uint64_t hash = 0;
  for (const std::int64_t id : line.ids)
  {
    hash = hash_of_id(static_cast<std::int64_t>(hash * 31 + static_cast<std::uint64_t>(id)));
  }
  return (hash >> 32) % ranks;
}

/// Compares lines of both frames, which come by rank and row. Returns the change of each.
std::vector<Change> find_changes(std::vector<Line> lines)
{
  std::vector<Change> changes(lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    lines[i].place = static_cast<std::int64_t>(i);
  }
  std::ranges::sort(lines);
  for (auto first = lines.begin(); first != lines.end();)
  {
    const auto last =
      std::find_if(first, lines.end(), [&](const Line& line) { return line.ids != first->ids; });
    const auto reference =
      std::find_if(first, last, [](const Line& line) { return line.is_reference != 0; });
    const auto kept = std::min(reference - first, last - reference); // of each frame
    for (auto line = first; line != last; ++line)
    {
      const bool is_kept = line - (line < reference ? first : reference) < kept;
      changes[static_cast<std::size_t>(line->place)] = is_kept ? Change::Kept
        : line < reference                                     ? Change::New
                                                               : Change::Lost;
    }
    first = last;
  }
  return changes;
}
}

LineChanges compare_lines(const LineEnds& current, const LineEnds& reference, Communicator& ranks)
{
  return do_together(ranks,
    [&]
    {
      std::vector<Line> lines;
      add_lines(current, false, lines);
      add_lines(reference, true, lines);
      const auto size = static_cast<std::size_t>(ranks.size());
      const ByRank sent =
        sort_by_rank(lines.size(), size, [&](std::size_t i) { return keeper_of(lines[i], size); });
      const std::vector<std::int64_t> come = swap_numbers(sent.counts, ranks);
      const std::vector<Change> answers =
        trade(find_changes(trade(pick(lines, sent.places), sent.counts, come, ranks)), come,
          sent.counts, ranks);
      std::vector<Change> changes(lines.size());
      for (std::size_t i = 0; i < answers.size(); ++i)
      {
        changes[static_cast<std::size_t>(sent.places[i])] = answers[i];
      }
      const auto middle = changes.begin() + std::ssize(current.id1);
      return LineChanges{ { changes.begin(), middle }, { middle, changes.end() } };
    });
}
}
