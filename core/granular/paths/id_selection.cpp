// SPDX-License-Identifier: BSD-3-Clause
#include "granular/paths/path_frame.h"

#include "granular/common/error.h"
#include "granular/common/words.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>
#include <utility>

namespace granular
{
namespace
{
/// Ranges up to this length become single ids, which are found at once.
constexpr std::int64_t short_range = 4096;

/// Reads an integer at the beginning of a text, and removes it.
bool take_integer(std::string_view& text, std::int64_t& number)
{
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return error == std::errc();
}

bool take(std::string_view& text, char sign)
{
  const bool there = !text.empty() && text.front() == sign;
  text.remove_prefix(there ? 1 : 0);
  return there;
}

void make_distinct(std::vector<std::int64_t>& ids)
{
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}
}

IdSet::IdSet(std::span<const std::int64_t> ids)
{
  constexpr std::uint64_t most_bits = std::uint64_t{ 1 } << 24; // 2 MiB
  if (ids.empty())
  {
    return;
  }
  const auto [lowest, highest] = std::ranges::minmax(ids);
  const std::uint64_t last =
    static_cast<std::uint64_t>(highest) - static_cast<std::uint64_t>(lowest);
  if (last < std::max<std::uint64_t>(most_bits, 64 * ids.size()))
  {
    lowest_ = lowest;
    bits_.resize(last / 64 + 1);
    for (const std::int64_t id : ids)
    {
      const std::uint64_t at = static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(lowest);
      bits_[at / 64] |= std::uint64_t{ 1 } << at % 64;
    }
    return;
  }
  table_ = IdTable(ids.size());
  for (const std::int64_t id : ids)
  {
    table_.add(id, 0);
  }
}

IdSelection::IdSelection(std::string_view text)
{
  std::vector<std::int64_t> ids;
  std::string spaced(text);
  std::replace(spaced.begin(), spaced.end(), ',', ' ');
  for (const std::string_view word : split_words(spaced))
  {
    listed_ = true;
    const Range range = read_range(word);
    if (range.first == range.last)
    {
      named_.push_back(range.first);
    }
    // differences of any two integers fit without a sign
    const std::uint64_t length =
      static_cast<std::uint64_t>(range.last) - static_cast<std::uint64_t>(range.first);
    const std::uint64_t steps = length / static_cast<std::uint64_t>(range.step);
    if (steps >= short_range)
    {
      ranges_.push_back(range);
      continue;
    }
    for (std::uint64_t i = 0; i <= steps; ++i)
    {
      // without a sign: the way from the first to the last may be longer than the largest integer
      ids.push_back(static_cast<std::int64_t>(
        static_cast<std::uint64_t>(range.first) + i * static_cast<std::uint64_t>(range.step)));
    }
  }
  ids_ = IdSet(ids);
}

IdSelection::Range IdSelection::read_range(std::string_view word)
{
  Range range;
  std::string_view rest = word;
  bool good = take_integer(rest, range.first);
  range.last = range.first;
  if (good && take(rest, '-'))
  {
    good = take_integer(rest, range.last);
    if (good && take(rest, ':'))
    {
      good = take_integer(rest, range.step);
    }
  }
  if (!good || !rest.empty() || range.last < range.first || range.step < 1)
  {
    throw Error(
      "expected ids like 5, ranges like 10-20 or 100-900:50, got '" + std::string(word) + "'");
  }
  return range;
}

void IdSelection::keep_only(std::span<const std::int64_t> ids)
{
  std::vector<std::int64_t> kept;
  std::ranges::copy_if(
    ids, std::back_inserter(kept), [this](std::int64_t id) { return this->holds(id); });
  narrow_ = IdSet(kept);
  narrowed_ = true;
}

bool IdSelection::is_listed(std::int64_t id) const noexcept
{
  const auto holds = [id](const Range& range)
  {
    return id >= range.first && id <= range.last &&
      (static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(range.first)) %
        static_cast<std::uint64_t>(range.step) ==
      0;
  };
  return ids_.contains(id) || std::any_of(ranges_.begin(), ranges_.end(), holds);
}

std::vector<std::int64_t> share_ids(std::span<const std::int64_t> ids, Communicator& ranks)
{
  std::vector<std::int64_t> all(ids.begin(), ids.end());
  make_distinct(all);
  const std::vector<std::vector<std::int64_t>> lists = gather(ranks, all);
  all.clear();
  for (const std::vector<std::int64_t>& list : lists)
  {
    all.insert(all.end(), list.begin(), list.end());
  }
  make_distinct(all);
  return all;
}

std::vector<std::int64_t> sample_ids(
  std::span<const std::int64_t> ids, std::size_t count, std::int64_t seed, Communicator& ranks)
{
  const auto salt = static_cast<std::int64_t>(hash_of_id(seed));
  const auto keep_smallest = [&](std::vector<std::int64_t> all)
  {
    if (all.size() > count)
    {
      // different ids have different hashes
      const auto hash = [salt](std::int64_t id) { return hash_of_id(id ^ salt); };
      std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count), all.end(),
        [&](std::int64_t a, std::int64_t b) { return hash(a) < hash(b); });
      all.resize(count);
    }
    return all;
  };
  std::vector<std::int64_t> own(ids.begin(), ids.end());
  make_distinct(own);
  std::vector<std::int64_t> sample = keep_smallest(share_ids(keep_smallest(std::move(own)), ranks));
  std::sort(sample.begin(), sample.end());
  return sample;
}
}
