// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/subdomain_tree.h"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <tuple>

namespace granular
{
namespace
{
constexpr std::size_t none = 3; ///< of the axes
constexpr std::size_t most_bins = 64;
constexpr double fewest_cells = 16; ///< along each axis
constexpr double most_cells = 128;

/// Planes that suit the boxes are looked for in the first third; halving 2^31 takes no more than the rest.
constexpr std::size_t most_levels = 128;

/// What decides between boxes with the same axes inside.
auto rank_of(const SubdomainTree::Box& box) noexcept
{
  return std::tie(box.lo[0], box.lo[1], box.lo[2], box.number);
}

/// Moves the last ones of boxes that are equal (flat ones may be) to the front, and tells how many are left over.
std::size_t drop_equal(std::span<SubdomainTree::Box> boxes)
{
  using Box = SubdomainTree::Box;
  std::ranges::sort(boxes,
    [](const Box& a, const Box& b)
    { return std::tie(a.lo, a.hi, b.number) < std::tie(b.lo, b.hi, a.number); });
  const auto end = std::unique(boxes.begin(), boxes.end(),
    [](const Box& a, const Box& b) { return a.lo == b.lo && a.hi == b.hi; });
  return static_cast<std::size_t>(boxes.end() - end);
}
}

int SubdomainTree::Box::inside(const double* x) const noexcept
{
  // & and no &&: one branch that can be foreseen, not six that cannot
  const int closed = int{ lo[0] <= x[0] } & int{ x[0] <= hi[0] } & int{ lo[1] <= x[1] } &
    int{ x[1] <= hi[1] } & int{ lo[2] <= x[2] } & int{ x[2] <= hi[2] };
  return closed != 0 ? int{ x[0] < hi[0] } + int{ x[1] < hi[1] } + int{ x[2] < hi[2] } : -1;
}

/// A plane: the lower half begins below it.
struct SubdomainTree::Split
{
  std::size_t axis = none;
  double plane = 0;
  double cost = 0;

  static double cost_of(std::size_t lower, std::size_t upper, std::size_t cut);
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
  if (!boxes_.empty())
  {
    nodes_.reserve(boxes_.size());
    root_ = this->build(0, boxes_.size(), 0);
    this->make_starts();
  }
}

/// How many steps points take, were there as many in each box: the halves are gone through alone, but those near
/// boxes that are cut take both.
double SubdomainTree::Split::cost_of(std::size_t lower, std::size_t upper, std::size_t cut)
{
  const auto steps = [cut](std::size_t half)
  {
    return (static_cast<double>(half) + 0.5 * static_cast<double>(cut)) *
      std::log2(static_cast<double>(half));
  };
  return steps(lower) + steps(upper);
}

/// Boxes are sorted into bins by where they begin; planes are the lowest begins of bins.
SubdomainTree::Split SubdomainTree::find_split(std::span<const Box> boxes)
{
  struct Bin
  {
    std::size_t begins = 0;
    std::size_t ends = 0;
    double lowest = HUGE_VAL;   ///< begin
    double highest = -HUGE_VAL; ///< end of those that begin here
  };
  const std::size_t count = std::min(most_bins, 4 * boxes.size());
  const auto last = static_cast<double>(count - 1);
  std::array<Bin, most_bins> bins;
  Split best;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto [least, most] = std::minmax_element(boxes.begin(), boxes.end(),
      [axis](const Box& a, const Box& b) { return a.lo[axis] < b.lo[axis]; });
    const double first = least->lo[axis];
    const double scale = static_cast<double>(count) / (most->lo[axis] - first);
    if (!std::isnormal(scale))
    {
      continue;
    }
    const auto bin_of = [&, low = first](double x)
    { return static_cast<std::size_t>(std::min(last, (x - low) * scale)); };
    std::fill_n(bins.begin(), count, Bin{});
    for (const Box& box : boxes)
    {
      Bin& bin = bins[bin_of(box.lo[axis])];
      ++bin.begins;
      ++bins[bin_of(box.hi[axis])].ends;
      bin.lowest = std::min(bin.lowest, box.lo[axis]);
      bin.highest = std::max(bin.highest, box.hi[axis]);
    }
    std::size_t lower = 0;
    std::size_t ended = 0;
    double highest = -HUGE_VAL;
    for (const Bin& bin : std::span(bins).first(count))
    {
      ended += bin.ends;
      if (lower > 0 && bin.begins > 0)
      {
        // those that begin and end in this bin may be among ended: an estimate
        const std::size_t cut = highest <= bin.lowest ? 0 : 1 + lower - std::min(ended, lower);
        const double cost = Split::cost_of(lower, boxes.size() - lower, cut);
        if (best.axis == none || cost < best.cost)
        {
          best = { axis, bin.lowest, cost };
        }
      }
      lower += bin.begins;
      highest = std::max(highest, bin.highest);
    }
  }
  return best;
}

/// Along an axis the median of where the boxes begin, or what is next to it where that is where all of the lower
/// half begin; none where all begin at one point. Halves what is left, whatever it is.
SubdomainTree::Split SubdomainTree::find_median(std::span<const Box> boxes)
{
  std::vector<double> begins(boxes.size());
  const auto middle = begins.begin() + static_cast<std::ptrdiff_t>(begins.size() / 2);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    std::ranges::transform(boxes, begins.begin(), [axis](const Box& box) { return box.lo[axis]; });
    std::nth_element(begins.begin(), middle, begins.end());
    double plane = *middle;
    if (*std::min_element(begins.begin(), middle + 1) == plane)
    {
      const auto later =
        std::partition(middle + 1, begins.end(), [plane](double begin) { return begin > plane; });
      if (later == middle + 1)
      {
        continue;
      }
      plane = *std::min_element(middle + 1, later);
    }
    return { axis, plane, 0 };
  }
  return {};
}

SubdomainTree::Place SubdomainTree::build(std::size_t first, std::size_t last, std::size_t level)
{
  if (last - first == 1)
  {
    return is_box | static_cast<Place>(first);
  }
  const std::span boxes = std::span(boxes_).subspan(first, last - first);
  Split split = level < most_levels / 3 ? find_split(boxes) : Split{};
  split = split.axis == none ? find_median(boxes) : split;
  std::size_t middle = boxes.size() / 2;
  if (split.axis != none)
  {
    const auto upper = std::partition(
      boxes.begin(), boxes.end(), [&](const Box& box) { return box.lo[split.axis] < split.plane; });
    middle = static_cast<std::size_t>(upper - boxes.begin());
  }
  else if (const auto equal = drop_equal(boxes); equal > 0) // all begin at one point
  {
    return this->build(first, last - equal, level);
  }
  else
  {
    split = { 0, boxes[0].lo[0], 0 };
  }
  double lower_end = -HUGE_VAL;
  for (const Box& box : boxes.first(middle))
  {
    lower_end = std::max(lower_end, box.hi[split.axis]);
  }
  const auto node = static_cast<Place>(nodes_.size());
  nodes_.push_back({ lower_end, split.plane, {}, static_cast<std::uint32_t>(split.axis) });
  const Place lower = this->build(first, first + middle, level + 1);
  const Place upper = this->build(first + middle, last, level + 1);
  nodes_[node].halves = { lower, upper };
  return node;
}

void SubdomainTree::make_starts()
{
  const double wanted = std::cbrt(2 * static_cast<double>(boxes_.size()));
  const double count = std::floor(std::clamp(wanted, fewest_cells, most_cells));
  cells_ = static_cast<std::uint32_t>(count);
  last_cell_ = count - 1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    double lo = HUGE_VAL;
    double hi = -HUGE_VAL;
    for (const Box& box : boxes_)
    {
      lo = std::min(lo, box.lo[axis]);
      hi = std::max(hi, box.hi[axis]);
    }
    const double scale = count / (hi - lo);
    if (std::isnormal(scale)) // else all are in the first cell
    {
      origin_[axis] = lo;
      scale_[axis] = scale;
    }
  }
  starts_.resize(std::size_t{ cells_ } * cells_ * cells_);
  this->set_starts(root_, { {}, { cells_, cells_, cells_ } });
}

/// Cells that lie in one half go down with it; the others begin here.
void SubdomainTree::set_starts(Place at, const Cells& cells)
{
  Cells both = cells;
  if ((at & is_box) == 0)
  {
    const Node& node = nodes_[at];
    const std::size_t axis = node.axis;
    const std::uint32_t first = cells.first[axis];
    const std::uint32_t last = cells.last[axis];
    both.first[axis] = std::clamp(this->cell_of(node.upper_begin, axis), first, last);
    both.last[axis] = std::clamp(this->cell_of(node.lower_end, axis) + 1, both.first[axis], last);
    Cells lower = cells;
    lower.last[axis] = both.first[axis];
    Cells upper = cells;
    upper.first[axis] = both.last[axis];
    if (first < lower.last[axis])
    {
      this->set_starts(node.halves[0], lower);
    }
    if (upper.first[axis] < last)
    {
      this->set_starts(node.halves[1], upper);
    }
  }
  for (std::size_t k = both.first[2]; k < both.last[2]; ++k)
  {
    for (std::size_t j = both.first[1]; j < both.last[1]; ++j)
    {
      const auto row = starts_.begin() + static_cast<std::ptrdiff_t>((k * cells_ + j) * cells_);
      std::fill(row + both.first[0], row + both.last[0], at);
    }
  }
}

const SubdomainTree::Box* SubdomainTree::find(const double* x) const noexcept
{
  if (boxes_.empty())
  {
    return nullptr;
  }
  std::array<Place, most_levels + 1> waiting; // one a level, and the first
  std::size_t waits = 1;
  const std::size_t row = std::size_t{ this->cell_of(x[2], 2) } * cells_ + this->cell_of(x[1], 1);
  waiting[0] = starts_[row * cells_ + this->cell_of(x[0], 0)];
  const Box* best = nullptr;
  int most = -1;
  while (waits > 0)
  {
    Place at = waiting[--waits];
    while ((at & is_box) == 0)
    {
      const Node& node = nodes_[at];
      const bool lower = x[node.axis] <= node.lower_end;
      const bool upper = x[node.axis] >= node.upper_begin;
      if (lower && upper) // seldom
      {
        waiting[waits++] = node.halves[0];
      }
      at = node.halves[upper ? 1 : 0];
    }
    const Box& box = boxes_[at & ~is_box];
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
  return best;
}
}
