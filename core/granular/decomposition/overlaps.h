// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_overlaps_h
#define granular_decomposition_overlaps_h

#include "granular/common/progress.h"
#include "granular/decomposition/subdomains.h"

#include <cstdint>
#include <span>
#include <utility>

namespace granular
{
/// Pairs of overlapping subdomains.
struct Overlaps
{
  std::int64_t pairs = 0;
  bool more = false;                                ///< more pairs than were counted
  std::pair<std::int64_t, std::int64_t> first = {}; ///< the counted pair with the lowest numbers
};

/// Counts the pairs that overlap by more than `allowed` along each axis; axes where it is below 0 are ignored. Bounds are
/// finite, lo <= hi. Stops after `most` pairs. Takes n log n, and more only if long subdomains cross: n^1.5 for rods woven
/// along three axes. Throws Cancelled.
Overlaps find_overlaps(std::span<const Subdomain> subdomains, const Vector3& allowed,
  std::int64_t most, Progress& progress);
}
#endif
