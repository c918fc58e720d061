// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_region_store_h
#define granular_packing_region_store_h

#include "granular/packing/random_grains.h"
#include "granular/packing/regions.h"

#include <cstdint>
#include <vector>

namespace granular
{
/// The regions that some rows need, and the memory for their grains: the rows' own where a region is in
/// them as a whole, else memory of the store.
class RegionStore
{
public:
  RegionStore(const Regions& regions, const GrainRows& rows);

  /// What is to be filled, in this order: regions with so many planes, by number.
  const std::vector<std::int64_t>& with_planes(int planes) const noexcept
  {
    return by_planes_[static_cast<std::size_t>(planes)];
  }

  /// The grains of a region that is to be filled.
  GrainRows grains(std::int64_t region) noexcept;

  /// Copies what the rows have of regions that are in them in part.
  void finish();

private:
  const Regions& regions_;
  GrainRows rows_;
  std::int64_t begin_ = 0; ///< regions that are in the rows as a whole
  std::int64_t end_ = 0;
  std::vector<std::int64_t> others_; ///< regions, by number
  std::vector<std::int64_t> starts_; ///< of their grains
  std::vector<double> scaled_;
  std::vector<double> radius_;
  std::vector<std::int64_t> by_planes_[4];
};
}
#endif
