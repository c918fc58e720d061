// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/subdomain_tree.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace granular
{
namespace
{
using Entry = SubdomainTree::Entry;
using Entries = std::span<Entry>;

constexpr std::size_t entries_a_leaf = 4;

/// Brings one of each kind of equal entries to the front, the last. Returns how many there are.
std::size_t keep_last(Entries entries)
{
  std::ranges::sort(entries,
    [](const Entry& a, const Entry& b)
    { return std::tie(a.lo, a.hi, b.number) < std::tie(b.lo, b.hi, a.number); });
  const auto end = std::unique(entries.begin(), entries.end(),
    [](const Entry& a, const Entry& b) { return a.lo == b.lo && a.hi == b.hi; });
  return static_cast<std::size_t>(end - entries.begin());
}

/// Brings the entries to the front that are longer than half of the bounds along an axis: a plane that divides the others
/// would cut them. Returns how many there are, or 0 where they or the others are few.
std::size_t divide_long(Entries entries, const Vector3& lo, const Vector3& hi)
{
  const std::size_t few = entries.size() / 8 + 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double half = hi[axis] / 2 - lo[axis] / 2;
    const auto is_long = [&](const Entry& entry) { return entry.hi[axis] - entry.lo[axis] > half; };
    const auto count = static_cast<std::size_t>(std::ranges::count_if(entries, is_long));
    if (count >= few && entries.size() - count >= few)
    {
      std::partition(entries.begin(), entries.end(), is_long);
      return count;
    }
  }
  return 0;
}

/// The axis along which not all begin where the bounds begin, and these are longest; 3: all begin at one point.
std::size_t longest_axis(Entries entries, const Vector3& lo, const Vector3& hi)
{
  std::size_t longest = 3;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const bool longer =
      longest == 3 || hi[axis] / 2 - lo[axis] / 2 > hi[longest] / 2 - lo[longest] / 2;
    if (longer &&
      std::ranges::any_of(entries, [&](const Entry& e) { return e.lo[axis] > lo[axis]; }))
    {
      longest = axis;
    }
  }
  return longest;
}

/// Brings those that begin lower along the axis to the front, about half of them, and returns how many. Those that
/// begin at the median stay together.
std::size_t divide_at_median(Entries entries, std::size_t axis)
{
  const auto begin_of = [axis](const Entry& entry) { return entry.lo[axis]; };
  const auto middle = entries.begin() + static_cast<std::ptrdiff_t>(entries.size() / 2);
  std::ranges::nth_element(entries, middle, {}, begin_of);
  const double median = begin_of(*middle);
  const auto first = std::partition(
    entries.begin(), middle, [&](const Entry& entry) { return begin_of(entry) < median; });
  const auto last = std::partition(
    middle, entries.end(), [&](const Entry& entry) { return begin_of(entry) == median; });
  const bool below =
    first != entries.begin() && (last == entries.end() || middle - first <= last - middle);
  return static_cast<std::size_t>((below ? first : last) - entries.begin());
}
}

SubdomainTree::SubdomainTree(std::vector<Entry> entries, bool drop_equal)
  : entries_(std::move(entries))
{
  nodes_.resize(1);
  this->build(0, 0, entries_.size(), drop_equal);
}

void SubdomainTree::build(std::size_t node, std::size_t first, std::size_t last, bool drop_equal)
{
  const Entries entries = Entries(entries_).subspan(first, last - first);
  Vector3 lo = { HUGE_VAL, HUGE_VAL, HUGE_VAL };
  Vector3 hi = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  for (const Entry& entry : entries)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      lo[axis] = std::min(lo[axis], entry.lo[axis]);
      hi[axis] = std::max(hi[axis], entry.hi[axis]);
    }
  }
  const bool is_leaf = entries.size() <= entries_a_leaf;
  const std::size_t axis = is_leaf ? 3 : longest_axis(entries, lo, hi);
  if (axis == 3)
  {
    const std::size_t kept = drop_equal ? keep_last(entries) : entries.size();
    const auto begin = static_cast<std::uint32_t>(first);
    nodes_[node] = { lo, hi, 0, begin, begin + static_cast<std::uint32_t>(kept), 0 };
    return;
  }
  const std::size_t count_long = divide_long(entries, lo, hi);
  const std::size_t middle =
    first + (count_long > 0 ? count_long : divide_at_median(entries, axis));
  const auto halves = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node] = { lo, hi, halves, 0, 0, static_cast<std::uint32_t>(axis) };
  nodes_.resize(halves + 2);
  this->build(halves, first, middle, drop_equal);
  this->build(halves + 1, middle, last, drop_equal);
}
}
