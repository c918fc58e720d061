// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_sorting_exchange_rows_h
#define granular_sorting_exchange_rows_h

#include "granular/memory/block.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/sorting/row_order.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// Moves rows between ranks so that each holds its part of the sorted rows of all. Collective.
class RowExchange
{
public:
  /// rows: the number of rows of all ranks. sorted: the sorted ids of this rank. Among equal ids those of lower ranks
  /// come first. Each rank gets exactly its part of all rows.
  RowExchange(std::int64_t rows, std::span<const std::int64_t> sorted, Communicator& ranks);

  std::int64_t rows() const noexcept { return rows_; } ///< that this rank gets

  /// Moves the rows of a block, width bytes each: orders them by `leave`, the order of the sorted ids, sends and
  /// receives them, and orders the received rows, which come by rank, by `arrive`.
  void move(Block& block, std::size_t width, const RowOrder& leave, const RowOrder& arrive,
    const Executor& executor) const;

private:
  Communicator& ranks_;
  std::vector<std::int64_t> out_; ///< rows for each rank
  std::vector<std::int64_t> in_;  ///< rows from each rank
  std::int64_t rows_;
};
}
#endif
