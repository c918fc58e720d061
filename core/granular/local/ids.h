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
/// The ids that an array of numbers holds: seen where they are if they lie there one after the other as Int64, else
/// converted.
class Ids
{
public:
  Ids() = default;

  /// Throws Error, with the name of the array and the row, where there is more than one number a row, or one that is no
  /// 64-bit integer: a fraction, nan, or too large; Cancelled; std::bad_alloc.
  Ids(const ArrayView& array, std::int64_t rows, const Executor& executor, Progress& progress);

  std::span<const std::int64_t> values() const noexcept { return values_; }

private:
  std::vector<std::int64_t> own_;
  std::span<const std::int64_t> values_; ///< stay where they are when this is moved
};
}
#endif
