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
  /// rows: of all ranks. sorted: the ids of this rank. Among equal ids those of the lower ranks are first.
  /// Each rank gets its part of all, exactly.
  RowExchange(std::int64_t rows, std::span<const std::int64_t> sorted, Communicator& ranks);

  std::int64_t rows() const noexcept { return rows_; } ///< that this rank gets

  /// Brings the rows of a block, width bytes each, into the order in which they leave, which is that of
  /// the sorted ids, sends and receives them, and brings what came, by rank, into the order arrive.
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
