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
  // the highest cut just reaches into a bin of its own
  const double scale = (static_cast<double>(bins) + 1e-6) / (cuts.back() - cuts.front());
  if (!std::isnormal(scale)) // the length is 0, or too small or too large to divide by
  {
    return;
  }
  guess_.origin_ = cuts.front() - 1 / scale;
  guess_.scale_ = scale;
  guess_.last_ = static_cast<double>(bins + 1);
  bins_.assign(bins + 2, { infinity, look_closer });
  // what is outside is below the lowest cut, or in the bin of the highest one or beyond
  const auto bin_of_cut = [&](std::size_t cut) { return guess_.bin_of(cuts[cut]); };
  const std::size_t end = bin_of_cut(cuts.size() - 1);
  std::size_t cut = 0; // the first one that is in no lower bin
  for (std::size_t bin = bin_of_cut(0); bin < end; ++bin)
  {
    while (bin_of_cut(cut) < bin)
    {
      ++cut;
    }
    const bool is_here = bin_of_cut(cut) == bin;
    if (!is_here || bin_of_cut(cut + 1) != bin)
    {
      bins_[bin] = { is_here ? cuts[cut] : infinity, static_cast<std::int32_t>(cut) - 1 };
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
