// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/subdomain_tree.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>

namespace granular
{
namespace
{
constexpr std::uint32_t leaf = 3;
constexpr std::size_t most_in_leaf = 4;

/// More than halving 2^31 twice along each axis can need. What were still together below is a long leaf.
constexpr std::size_t most_levels = 96;

/// What decides between boxes with the same axes inside.
auto rank_of(const SubdomainTree::Box& box) noexcept
{
  return std::tie(box.lo[0], box.lo[1], box.lo[2], box.number);
}
}

int SubdomainTree::Box::inside(const double* x) const noexcept
{
  int axes = 0;
  bool closed = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    closed = closed && lo[axis] <= x[axis] && x[axis] <= hi[axis];
    axes += x[axis] < hi[axis] ? 1 : 0;
  }
  return closed ? axes : -1;
}

/// A plane: the lower half begins below it.
struct SubdomainTree::Split
{
  std::size_t axis = leaf;
  double plane = 0;
  std::size_t cost = 0; ///< of the larger half, with those of the lower one that the plane cuts
};

SubdomainTree::SubdomainTree(std::span<const Subdomain> subdomains)
{
  for (std::size_t i = 0; i < subdomains.size(); ++i)
  {
    const auto& [lo, hi, particles, rank] = subdomains[i];
    if (lo[0] <= hi[0] && lo[1] <= hi[1] && lo[2] <= hi[2])
    {
      boxes_.push_back({ lo, hi, static_cast<std::int64_t>(i) });
    }
  }
  scratch_.resize(boxes_.size());
  this->build(0, boxes_.size(), 0);
  scratch_ = {};
}

/// Along each axis the median of where the boxes begin, or what is next to it where that is where all of the lower
/// half begin: the best one, or none where all begin at one point.
SubdomainTree::Split SubdomainTree::find_split(std::size_t first, std::size_t last)
{
  const std::size_t count = last - first;
  const std::span<const Box> boxes(boxes_.data() + first, count);
  const std::span<double> begins(scratch_.data(), count);
  Split best;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    std::ranges::transform(boxes, begins.begin(), [axis](const Box& box) { return box.lo[axis]; });
    const auto middle = begins.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(begins.begin(), middle, begins.end());
    double plane = *middle;
    if (*std::min_element(begins.begin(), middle + 1) == plane)
    {
      const auto above =
        std::partition(middle + 1, begins.end(), [plane](double begin) { return begin > plane; });
      if (above == middle + 1)
      {
        continue; // nothing begins later
      }
      plane = *std::min_element(middle + 1, above);
    }
    std::size_t lower = 0;
    std::size_t cut = 0;
    for (const Box& box : boxes)
    {
      const bool is_lower = box.lo[axis] < plane;
      lower += static_cast<std::size_t>(is_lower);
      cut += static_cast<std::size_t>(is_lower && box.hi[axis] > plane);
    }
    const std::size_t cost = std::max(lower, count - lower) + cut;
    if (best.axis == leaf || cost < best.cost)
    {
      best = { axis, plane, cost };
    }
  }
  return best;
}

void SubdomainTree::build(std::size_t first, std::size_t last, std::size_t level)
{
  const bool is_short = last - first <= most_in_leaf || level == most_levels;
  const Split split = is_short ? Split{} : this->find_split(first, last);
  if (split.axis == leaf)
  {
    this->add_leaf(first, last);
    return;
  }
  const auto begin = boxes_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = boxes_.begin() + static_cast<std::ptrdiff_t>(last);
  const std::size_t axis = split.axis;
  const auto middle =
    std::partition(begin, end, [&](const Box& box) { return box.lo[axis] < split.plane; });
  const auto by_end = [axis](const Box& a, const Box& b) { return a.hi[axis] < b.hi[axis]; };
  const std::size_t node = nodes_.size();
  nodes_.push_back({ std::max_element(begin, middle, by_end)->hi[axis], split.plane, 0, 0,
    static_cast<std::uint32_t>(axis) });
  const std::size_t half = static_cast<std::size_t>(middle - boxes_.begin());
  this->build(first, half, level + 1);
  nodes_[node].first = static_cast<std::uint32_t>(nodes_.size());
  this->build(half, last, level + 1);
}

/// Boxes that are equal (flat ones may be) would be many: of them the last one counts.
void SubdomainTree::add_leaf(std::size_t first, std::size_t last)
{
  const auto begin = boxes_.begin() + static_cast<std::ptrdiff_t>(first);
  const auto end = boxes_.begin() + static_cast<std::ptrdiff_t>(last);
  std::sort(begin, end,
    [](const Box& a, const Box& b)
    { return std::tie(a.lo, a.hi, b.number) < std::tie(b.lo, b.hi, a.number); });
  const auto kept = std::unique(
    begin, end, [](const Box& a, const Box& b) { return a.lo == b.lo && a.hi == b.hi; });
  nodes_.push_back(
    { 0, 0, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(kept - begin), leaf });
}

const SubdomainTree::Box* SubdomainTree::find(const double* x) const noexcept
{
  std::array<std::uint32_t, most_levels + 1> waiting; // one a level, and the root
  std::size_t waits = 1;
  waiting[0] = 0;
  const Box* best = nullptr;
  int most = -1;
  while (waits > 0)
  {
    std::uint32_t at = waiting[--waits];
    bool open = true;
    while (open && nodes_[at].axis != leaf)
    {
      const Node& node = nodes_[at];
      const bool lower = x[node.axis] <= node.lower_end;
      const bool upper = x[node.axis] >= node.upper_begin;
      if (lower && upper)
      {
        waiting[waits++] = at + 1;
      }
      open = lower || upper;
      at = upper ? node.first : at + 1;
    }
    const std::uint32_t boxes = open ? nodes_[at].count : 0;
    for (std::uint32_t i = 0; i < boxes; ++i)
    {
      const Box& box = boxes_[nodes_[at].first + i];
      const int axes = box.inside(x);
      if (axes == 3)
      {
        return &box;
      }
      if (axes > most || (axes >= 0 && axes == most && rank_of(*best) < rank_of(box)))
      {
        best = &box;
        most = axes;
      }
    }
  }
  return best;
}
}
