// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_sorting_find_ids_at_h
#define granular_sorting_find_ids_at_h

#include "granular/parallel/communicator.h"

#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// Returns the ids that have these places among the sorted ids of all ranks: for each the smallest id with more ids up to
/// it than the place has before it. Found by halving, for all places at once, the same on all ranks. Collective.
std::vector<std::int64_t> find_ids_at(const std::vector<std::int64_t>& places,
  std::span<const std::int64_t> sorted, Communicator& ranks);
}
#endif
