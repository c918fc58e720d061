// SPDX-License-Identifier: BSD-3-Clause
#include "granular/packing/region_store.h"

#include <algorithm>
#include <bit>

namespace granular
{
RegionStore::RegionStore(const Regions& regions, const GrainRows& rows)
  : regions_(regions)
  , rows_(rows)
{
  if (rows.count() == 0)
  {
    return;
  }
  const std::int64_t first = regions.find(rows.first);
  const std::int64_t last = regions.find(rows.last - 1);
  begin_ = regions.first(first) < rows.first ? first + 1 : first;
  end_ = regions.first(last + 1) > rows.last ? last : last + 1;
  end_ = std::max(begin_, end_);
  const auto add = [this](std::int64_t region)
  {
    if (region < begin_ || region >= end_)
    {
      others_.push_back(region);
    }
  };
  for (std::int64_t region = first; region <= last; ++region)
  {
    add(region);
    regions.visit_rim(
      regions.region(region), [&add](std::int64_t rim, const Vector3&) { add(rim); });
  }
  std::sort(others_.begin(), others_.end());
  others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
  std::int64_t grains = 0;
  for (const std::int64_t region : others_)
  {
    starts_.push_back(grains);
    grains += regions.first(region + 1) - regions.first(region);
  }
  scaled_.resize(static_cast<std::size_t>(3 * grains));
  radius_.resize(static_cast<std::size_t>(grains));
  for (std::int64_t region = begin_; region < end_; ++region)
  {
    by_planes_[std::popcount(static_cast<unsigned>(region % 8))].push_back(region);
  }
  for (const std::int64_t region : others_)
  {
    by_planes_[std::popcount(static_cast<unsigned>(region % 8))].push_back(region);
  }
}

GrainRows RegionStore::grains(std::int64_t region) noexcept
{
  GrainRows grains = { { regions_.first(region), regions_.first(region + 1) } };
  if (region >= begin_ && region < end_)
  {
    const std::int64_t row = grains.first - rows_.first;
    grains.scaled = rows_.scaled + 3 * row;
    grains.radius = rows_.radius + row;
    return grains;
  }
  const auto other = std::lower_bound(others_.begin(), others_.end(), region) - others_.begin();
  const std::int64_t start = starts_[static_cast<std::size_t>(other)];
  grains.scaled = scaled_.data() + 3 * start;
  grains.radius = radius_.data() + start;
  return grains;
}

void RegionStore::finish()
{
  for (const std::int64_t region : others_)
  {
    const GrainRows from = this->grains(region);
    const std::int64_t first = std::max(from.first, rows_.first);
    const std::int64_t count = std::min(from.last, rows_.last) - first;
    if (count > 0)
    {
      const std::int64_t to = first - rows_.first;
      std::copy_n(from.scaled + 3 * (first - from.first), 3 * count, rows_.scaled + 3 * to);
      std::copy_n(from.radius + (first - from.first), count, rows_.radius + to);
    }
  }
}
}
