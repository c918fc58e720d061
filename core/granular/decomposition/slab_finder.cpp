// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/slab_finder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace granular
{
namespace
{
constexpr std::size_t bins_per_slab = 8;
constexpr std::size_t fewest_bins = 256;
constexpr std::size_t most_bins = std::size_t{ 1 } << 20;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int32_t look_closer = std::numeric_limits<std::int32_t>::min();
}

SlabFinder::SlabFinder(std::span<const double> cuts)
  : bins_(1, { infinity, look_closer })
  , cuts_(cuts.begin(), cuts.end())
{
  if (cuts.size() < 2)
  {
    return;
  }
  const std::size_t bins = std::clamp(bins_per_slab * (cuts.size() - 1), fewest_bins, most_bins);
  const double scale = static_cast<double>(bins) / (cuts.back() - cuts.front());
  if (!std::isnormal(scale)) // the length is 0, or too small or too large to divide by
  {
    return;
  }
  origin_ = cuts.front() - 1 / scale;
  scale_ = scale;
  last_ = static_cast<double>(bins + 1);
  bins_.assign(bins + 2, { infinity, look_closer });
  // what is outside is in the bins of the ends or beyond them
  const std::size_t end = this->bin_of(cuts.back());
  std::size_t slab = 0;
  for (std::size_t bin = this->bin_of(cuts.front()) + 1; bin < end; ++bin)
  {
    const auto next = [&](std::size_t ahead) { return this->bin_of(cuts[slab + ahead]); };
    while (next(1) < bin)
    {
      ++slab;
    }
    const bool has_cut = next(1) == bin;
    if (!has_cut || next(2) != bin)
    {
      bins_[bin] = { has_cut ? cuts[slab + 1] : infinity, static_cast<std::int32_t>(slab) };
    }
  }
}

std::int32_t SlabFinder::search(double x) const noexcept
{
  if (cuts_.size() < 2 || !(cuts_.front() <= x && x <= cuts_.back()))
  {
    return -1;
  }
  const auto first = cuts_.begin() + 1;
  return static_cast<std::int32_t>(std::upper_bound(first, cuts_.end() - 1, x) - first);
}
}
