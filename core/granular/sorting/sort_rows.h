// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_sorting_sort_rows_h
#define granular_sorting_sort_rows_h

#include "granular/memory/block.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/table.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace granular
{
/// An order of rows that can be applied to many blocks.
class RowOrder
{
public:
  /// Makes the order by id; rows with the same id keep their order. Throws std::bad_alloc.
  explicit RowOrder(std::span<const std::int64_t> ids);

  /// Brings the rows of a block, width bytes each, into this order. Empty blocks are unchanged. Throws std::bad_alloc.
  void apply(Block& block, std::size_t width, const Executor& executor) const;

private:
  Block rows_; ///< std::uint64_t: from where each row comes; empty: they stay
};

/// Sorts the rows of a frame by id; rows with the same id keep their order. ids holds frame.rows ids, or is empty if
/// the frame has an array with the role Id. Without either, the order is unchanged and a notice says so.
void sort_by_id(Table& frame, const Block& ids, Notices& notices, const Where& where,
  const Executor& executor = Executor());

/// Sorts the rows of all ranks by id, and those with the same id by rank and then by their order. Rank r of n keeps
/// part r of n (begin_of_part in shares), so that the ranks together hold what one rank would. All ranks must have the
/// same arrays, also ranks without rows; texts get the words of all ranks. Without ids nothing moves, and each rank
/// gets the notice. Throws on all ranks (see agree); the frame is lost then. Needs memory for one more copy of the
/// largest block and about 40 bytes per row. Collective.
void sort_by_id(Table& frame, const Block& ids, Communicator& ranks, Notices& notices,
  const Where& where, const Executor& executor = Executor());

/// Keeps `count` rows from `first` on and removes the others.
void keep_rows(Table& frame, std::int64_t first, std::int64_t count);
}
#endif
