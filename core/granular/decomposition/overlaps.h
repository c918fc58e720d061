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
/// Pairs of subdomains that share room.
struct Overlaps
{
  std::int64_t pairs = 0;
  bool more = false;                                ///< more pairs than were counted
  std::pair<std::int64_t, std::int64_t> first = {}; ///< of those counted that of the lowest numbers
};

/// Counts the pairs that overlap by more than `allowed` along each axis; an axis where that is below 0 is
/// not looked at. Bounds are finite, lo <= hi. Stops after `most` pairs. Takes n log n, and more only
/// where long subdomains cross: n^1.5 for rods that are woven along three axes. Throws Cancelled.
Overlaps find_overlaps(std::span<const Subdomain> subdomains, const Vector3& allowed,
  std::int64_t most, Progress& progress);
}
#endif
