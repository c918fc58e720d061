// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_row_range_h
#define granular_packing_row_range_h

#include <cstdint>

namespace granular
{
/// Rows of grains, from first to last - 1; a grain's id is its row + 1.
struct RowRange
{
  std::int64_t first = 0;
  std::int64_t last = 0;

  std::int64_t count() const noexcept { return last - first; }
};
}
#endif
