// SPDX-License-Identifier: BSD-3-Clause
// After A. Zomorodian, H. Edelsbrunner, "Fast software for box intersections", Int. J. Comput. Geom. Appl. 12
// (2002): two intervals meet where one holds the low end of the other. Along one axis after the other a segment tree,
// of which only the current path is there at a time, brings those together that do.
#include "granular/decomposition/overlaps.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

namespace granular
{
namespace
{
using Place = std::uint32_t;

/// A subdomain by the places of its ends among the low ends of all along each axis: [begin, end) holds those low
/// ends that lie in it. No two begin at the same place, so that of two that begin together one holds the other's.
struct Ranked
{
  std::array<Place, 3> begin;
  std::array<Place, 3> end;
  Place number; ///< of the subdomain

  bool holds_begin_of(const Ranked& other, std::size_t axis) const noexcept
  {
    return begin[axis] < other.begin[axis] && other.begin[axis] < end[axis];
  }

  bool meets(const Ranked& other, std::size_t axis) const noexcept
  {
    return this->holds_begin_of(other, axis) || other.holds_begin_of(*this, axis);
  }
};

using Part = std::span<Ranked>;

/// Fewer are compared each with each.
constexpr std::size_t few = 32;

/// The axis along which the search begins.
constexpr std::size_t first_axis = 2;

/// Progress is reported each time so many were looked at.
constexpr std::size_t report_interval = std::size_t{ 1 } << 20;

class Search
{
public:
  Search(Overlaps& found, std::int64_t most, std::size_t places, Progress& progress)
    : found_(found)
    , most_(most)
    , end_(static_cast<Place>(places))
    , progress_(progress)
  {
  }

  /// Finds the pairs of which the holder holds the begin of the other along the axis and meets it along those before.
  /// The begins of `held` lie in [lo, hi), and every holder has some part of that.
  void run(Part held, Part holders, Place lo, Place hi, std::size_t axis)
  {
    if (held.empty() || holders.empty() || found_.more)
    {
      return;
    }
    this->report(held.size() + holders.size(), axis, lo);
    if (axis == 0)
    {
      this->scan(held, holders);
      return;
    }
    if (held.size() < few || holders.size() < few)
    {
      this->compare(held, holders, axis);
      return;
    }
    const auto all_of_it = [&](const Ranked& each)
    { return each.begin[axis] < lo && hi <= each.end[axis]; };
    const std::size_t whole = divide(holders, all_of_it);
    const Part whole_holders = holders.first(whole);
    this->run(held, whole_holders, 0, end_, axis - 1);
    this->run(whole_holders, held, 0, end_, axis - 1);

    const Part others = holders.subspan(whole);
    const std::size_t low = held.size() / 2;
    const Place middle = place_of(held, low, axis);
    const std::size_t low_holders =
      divide(others, [&](const Ranked& each) { return each.begin[axis] + 1 < middle; });
    this->run(held.first(low), others.first(low_holders), lo, middle, axis);
    const std::size_t high_holders =
      divide(others, [&](const Ranked& each) { return each.end[axis] > middle; });
    this->run(held.subspan(low), others.first(high_holders), middle, hi, axis);
  }

private:
  /// Places before lo are done along the first axis.
  void report(std::size_t work, std::size_t axis, Place lo)
  {
    done_ = axis == first_axis ? lo : done_;
    work_ += work;
    if (work_ >= report_interval)
    {
      work_ = 0;
      progress_.step(static_cast<double>(done_) / static_cast<double>(end_));
    }
  }

  /// Brings those to the front for which it is so, and says how many they are.
  template <class Predicate>
  static std::size_t divide(Part part, const Predicate& predicate)
  {
    return static_cast<std::size_t>(
      std::partition(part.begin(), part.end(), predicate) - part.begin());
  }

  /// Where the one begins that has `low` before it, who are brought to the front.
  static Place place_of(Part part, std::size_t low, std::size_t axis)
  {
    const auto middle = part.begin() + static_cast<std::ptrdiff_t>(low);
    std::nth_element(part.begin(), middle, part.end(),
      [&](const Ranked& a, const Ranked& b) { return a.begin[axis] < b.begin[axis]; });
    return middle->begin[axis];
  }

  static void sort(Part part)
  {
    std::sort(part.begin(), part.end(),
      [](const Ranked& a, const Ranked& b) { return a.begin[0] < b.begin[0]; });
  }

  /// Along the first axis, when all else is known.
  void scan(Part held, Part holders)
  {
    sort(held);
    sort(holders);
    auto from = held.begin();
    for (const Ranked& holder : holders)
    {
      from = std::find_if(
        from, held.end(), [&](const Ranked& each) { return each.begin[0] > holder.begin[0]; });
      for (auto each = from; each != held.end() && each->begin[0] < holder.end[0]; ++each)
      {
        this->add(holder, *each);
      }
      if (found_.more)
      {
        return;
      }
    }
  }

  void compare(Part held, Part holders, std::size_t axis)
  {
    for (const Ranked& holder : holders)
    {
      for (const Ranked& each : held)
      {
        if (holder.holds_begin_of(each, axis) && holder.meets(each, 0) &&
          (axis == 1 || holder.meets(each, 1)))
        {
          this->add(holder, each);
        }
      }
    }
  }

  void add(const Ranked& a, const Ranked& b) noexcept
  {
    if (found_.pairs == most_)
    {
      found_.more = true;
      return;
    }
    const std::pair<std::int64_t, std::int64_t> pair = std::minmax(a.number, b.number);
    found_.first = found_.pairs == 0 ? pair : std::min(found_.first, pair);
    ++found_.pairs;
  }

  Overlaps& found_;
  std::int64_t most_;
  Place end_;
  Progress& progress_;
  Place done_ = 0;
  std::size_t work_ = 0; ///< since progress was reported
};

/// Those that are thick enough to overlap at all.
std::vector<Ranked> thick_ones(std::span<const Subdomain> subdomains, const Vector3& allowed)
{
  std::vector<Ranked> thick;
  for (std::size_t i = 0; i < subdomains.size(); ++i)
  {
    const Subdomain& each = subdomains[i];
    const auto is_thick = [&](std::size_t axis)
    { return !(allowed[axis] >= 0) || each.lo[axis] < each.hi[axis] - allowed[axis]; };
    if (is_thick(0) && is_thick(1) && is_thick(2))
    {
      thick.push_back({ {}, {}, static_cast<Place>(i) });
    }
  }
  return thick;
}

/// Along an axis that is not looked at each holds all that come after it.
void rank_all(std::vector<Ranked>& all, std::size_t axis)
{
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    all[i].begin[axis] = static_cast<Place>(i);
    all[i].end[axis] = static_cast<Place>(all.size());
  }
}

void rank(
  std::vector<Ranked>& all, std::span<const Subdomain> subdomains, std::size_t axis, double allowed)
{
  std::vector<std::pair<double, Place>> order(all.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    order[i] = { subdomains[all[i].number].lo[axis], static_cast<Place>(i) };
  }
  std::sort(order.begin(), order.end());
  for (std::size_t place = 0; place < order.size(); ++place)
  {
    all[order[place].second].begin[axis] = static_cast<Place>(place);
  }
  for (Ranked& each : all)
  {
    const double end = subdomains[each.number].hi[axis] - allowed;
    const auto found = std::lower_bound(order.begin(), order.end(), std::pair(end, Place{ 0 }));
    each.end[axis] = static_cast<Place>(found - order.begin());
  }
}

/// Puts the axes into the order in which less and less is held along them: the search begins with the last, and
/// what it tells apart there need not be looked at along others.
void sort_axes(std::vector<Ranked>& all)
{
  std::array<double, 3> held = {};
  for (const Ranked& each : all)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      held[axis] += each.end[axis] - each.begin[axis];
    }
  }
  std::array<std::size_t, 3> order = { 0, 1, 2 };
  std::sort(
    order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return held[a] > held[b]; });
  for (Ranked& each : all)
  {
    each.begin = { each.begin[order[0]], each.begin[order[1]], each.begin[order[2]] };
    each.end = { each.end[order[0]], each.end[order[1]], each.end[order[2]] };
  }
}
}

Overlaps find_overlaps(std::span<const Subdomain> subdomains, const Vector3& allowed,
  std::int64_t most, Progress& progress)
{
  if (subdomains.size() > std::numeric_limits<Place>::max())
  {
    throw LimitError(
      "expected less than 2^32 subdomains, got " + std::to_string(subdomains.size()));
  }
  std::vector<Ranked> held = thick_ones(subdomains, allowed);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    progress.step(0);
    if (allowed[axis] >= 0)
    {
      rank(held, subdomains, axis, allowed[axis]);
    }
    else
    {
      rank_all(held, axis);
    }
  }
  sort_axes(held);
  Overlaps found;
  std::vector<Ranked> holders = held;
  Search(found, most, held.size(), progress)
    .run(held, holders, 0, static_cast<Place>(held.size()), first_axis);
  return found;
}
}
