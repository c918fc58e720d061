// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_ids_h
#define granular_local_ids_h

#include "granular/common/progress.h"
#include "granular/parallel/executor.h"
#include "granular/particles/frame_view.h"

#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// The ids in an array of numbers: used in place if they are contiguous Int64, otherwise converted.
class Ids
{
public:
  Ids() = default;

  /// Throws Error with the array's name and the row if there is more than one number per row, or one that is not a
  /// 64-bit integer: a fraction, nan, or too large; Cancelled; std::bad_alloc.
  Ids(const ArrayView& array, std::int64_t rows, const Executor& executor, Progress& progress);

  std::span<const std::int64_t> values() const noexcept { return values_; }

private:
  std::vector<std::int64_t> own_;
  std::span<const std::int64_t> values_; ///< stay where they are when this is moved
};
}
#endif
