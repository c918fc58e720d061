// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_sorting_sort_rows_h
#define granular_sorting_sort_rows_h

#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/dump_frame.h"

#include <cstdint>

namespace granular
{
/// Brings the rows of a frame into the order of their ids; rows of the same id keep theirs.
/// ids holds frame.rows ids, or is empty if the frame has an array with the role Id. If there are
/// neither, the order stays and a notice says so.
void sort_by_id(DumpFrame& frame, const Block& ids, Notices& notices, const Where& where,
  const Executor& executor = Executor());

/// The same for a frame whose rows are spread over the ranks, who all call this: sorts the rows of all,
/// those of the same id by rank and then as they were, and leaves rank r of n with part r of n of them
/// (begin_of_part in shares), so that the ranks one after the other hold what one process would. All ranks
/// have the same arrays, also those without rows; texts get the words of all ranks. Without ids
/// nothing moves, and each rank gets the notice. Throws on all ranks (see agree); the frame is lost then.
/// Needs memory for one more copy of the largest block, and some 40 bytes a row.
void sort_by_id(DumpFrame& frame, const Block& ids, Communicator& ranks, Notices& notices,
  const Where& where, const Executor& executor = Executor());

/// Leaves count rows from first on.
void keep_rows(DumpFrame& frame, std::int64_t first, std::int64_t count);
}
#endif
