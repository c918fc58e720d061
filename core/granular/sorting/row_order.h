// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_sorting_row_order_h
#define granular_sorting_row_order_h

#include "granular/memory/block.h"
#include "granular/parallel/executor.h"

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
}
#endif
