// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_sorting_sort_rows_h
#define granular_sorting_sort_rows_h

#include "granular/memory/block.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/table.h"

#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// Sorts the rows of all ranks by id, and those with the same id by rank and then by their order. ids holds frame.rows ids, or
/// is empty if the frame has an array with the role Id. Rank r of n keeps part r of n (begin_of_part in shares), so that the
/// ranks together hold what one rank would. All ranks must have the same arrays, also ranks without rows; texts get the words
/// of all ranks. Without ids nothing moves, and each rank gets a notice. Throws on all ranks (see agree); the frame is lost
/// then. Needs memory for one more copy of the largest block and about 40 bytes per row. Collective.
void sort_by_id(Table& frame, const Block& ids, Communicator& ranks, Notices& notices,
  const Where& where, const Executor& executor = Executor());

/// Returns the ids that have these places among the sorted ids of all ranks: for each the smallest id with more ids up to
/// it than the place has before it. Found by halving, for all places at once, the same on all ranks. Collective.
std::vector<std::int64_t> find_ids_at(const std::vector<std::int64_t>& places,
  std::span<const std::int64_t> sorted, Communicator& ranks);

/// Keeps `count` rows from `first` on and removes the others.
void keep_rows(Table& frame, std::int64_t first, std::int64_t count);
}
#endif
