// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_frame_plan_h
#define granular_dump_write_frame_plan_h

#include "granular/dump/write/column_plan.h"
#include "granular/dump/write/dump_format.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// What all ranks must know of a frame before they write it.
struct FramePlan
{
  FrameHeader header;                  ///< rows are those of all ranks
  ColumnPlan columns;                  ///< of this rank
  std::vector<std::int64_t> kept_rows; ///< of each rank, duplicates left out
  double smallest_radius = HUGE_VAL;   ///< of all ranks; HUGE_VAL: none, or nothing is rounded
};

/// Agrees on header and columns: they are those of the first rank that has rows, and a rank without rows need
/// have nothing else. A frame without a box gets one from the bounds of all its grains, with a notice; local data have
/// none then.
/// Throws Error, on all ranks, if the ranks have other arrays, or the format wants what the frame does not
/// have: a box with a volume for scaled coordinates, units, a time. Notices are on all ranks. Collective.
FramePlan plan_frame(
  const FrameView& frame, const DumpFormat& format, Communicator& ranks, Notices& notices);
}
#endif
