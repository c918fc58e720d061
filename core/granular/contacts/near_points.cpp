// SPDX-License-Identifier: BSD-3-Clause
#include "granular/contacts/near_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace granular
{
bool Extent::meets(const Extent& other) const noexcept
{
  bool meets = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    meets = meets && lo[axis] <= other.hi[axis] && hi[axis] >= other.lo[axis];
  }
  return meets;
}

void Extent::include(const Vector3& point) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lo[axis] = std::min(lo[axis], point[axis]);
    hi[axis] = std::max(hi[axis], point[axis]);
  }
}

Extent Extent::grown(double by) const noexcept
{
  Extent grown = *this;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    grown.lo[axis] = std::nextafter(grown.lo[axis] - by, -HUGE_VAL);
    grown.hi[axis] = std::nextafter(grown.hi[axis] + by, HUGE_VAL);
  }
  return grown;
}

Extent extent_of(std::span<const double> points) noexcept
{
  Extent extent;
  for (std::size_t i = 0; i + 3 <= points.size(); i += 3)
  {
    const Vector3 point = { points[i], points[i + 1], points[i + 2] };
    if (std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]))
    {
      extent.include(point);
    }
  }
  return extent;
}

Bins::Bins(const Extent& whole, double edge, std::span<const Extent> things)
  : whole_(whole)
{
  if (whole.empty())
  {
    return;
  }
  // as many bins as there are things, or some more
  const double most = 4 * static_cast<double>(things.size()) + 64;
  double count = 1;
  std::array<double, 3> counts;
  for (double by = edge;; by *= 2)
  {
    count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      counts[axis] =
        std::floor(whole.hi[axis] / by - whole.lo[axis] / by) + 1; // no overflow in the end
      per_edge_[axis] = 1 / by;
      count *= counts[axis];
    }
    if (count <= most)
    {
      break;
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    all_.last[axis] = static_cast<std::int64_t>(counts[axis]);
  }
  starts_.resize(static_cast<std::size_t>(all_.size()) + 1);
  const auto each_bin = [&](const Extent& thing, const auto& take)
  {
    if (thing.meets(whole_))
    {
      this->range(thing).each([&](const std::array<std::int64_t, 3>& bin)
        { take(static_cast<std::size_t>(all_.number(bin))); });
    }
  };
  for (const Extent& thing : things)
  {
    each_bin(thing, [&](std::size_t bin) { ++starts_[bin + 1]; });
  }
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  things_.resize(static_cast<std::size_t>(starts_.back()));
  std::vector<std::int64_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < things.size(); ++i)
  {
    each_bin(things[i],
      [&](std::size_t bin)
      { things_[static_cast<std::size_t>(next[bin]++)] = static_cast<std::uint32_t>(i); });
  }
}

CellRange Bins::range(const Extent& extent) const noexcept
{
  CellRange range;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto bin = [&](double x)
    {
      const double place = std::floor((x - whole_.lo[axis]) * per_edge_[axis]);
      return static_cast<std::int64_t>(
        std::clamp(place, 0.0, static_cast<double>(all_.last[axis] - 1)));
    };
    range.first[axis] = bin(extent.lo[axis]);
    range.last[axis] = bin(extent.hi[axis]) + 1;
  }
  return range;
}

std::span<const std::uint32_t> Bins::near(const Vector3& point) const noexcept
{
  if (!Extent{ point, point }.meets(whole_)) // false for nan
  {
    return {};
  }
  const auto bin = static_cast<std::size_t>(all_.number(this->range({ point, point }).first));
  const auto first = static_cast<std::size_t>(starts_[bin]);
  return std::span(things_).subspan(first, static_cast<std::size_t>(starts_[bin + 1]) - first);
}
}
