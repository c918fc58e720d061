// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_write_frame_plan_h
#define granular_formats_dump_write_frame_plan_h

#include "granular/formats/dump/write/column_plan.h"
#include "granular/formats/dump/write/dump_format.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/frame_view.h"
#include "granular/particles/table.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// Data of a frame that all ranks must know before they write it.
struct FramePlan
{
  FrameHeader header;                  ///< rows: of all ranks
  ColumnPlan columns;                  ///< of this rank
  std::vector<std::int64_t> kept_rows; ///< of each rank, without duplicates
  double smallest_radius = HUGE_VAL;   ///< of all ranks; HUGE_VAL: no radii, or nothing is rounded
};

/// Agrees on header and columns: those of the first rank that has rows; a rank without rows needs nothing else. A frame
/// without a box gets one from the bounds of all its particles, with a notice; local data then have none. Throws Error, on
/// all ranks, if the ranks have different arrays, or if the frame lacks what the format needs: a box with a volume for scaled
/// coordinates, units, a time. Notices are on all ranks. Collective.
FramePlan plan_frame(
  const FrameView& frame, const DumpFormat& format, Communicator& ranks, Notices& notices);

/// The columns of a frame to be written, copied and sorted by id.
class SortedRows
{
public:
  /// Copies the rows of the view, without duplicates, in the columns of the plan, and gives each rank its part of all sorted
  /// rows: see sort_by_id. The plan then belongs to view(). The frame must have ids. Collective.
  SortedRows(const FrameView& frame, FramePlan& plan, Communicator& ranks, const Executor& executor,
    Progress& progress);

  const FrameView& view() const noexcept { return view_; }

private:
  void copy(const FrameView& frame, const FramePlan& plan, int rank, Progress& progress);
  void show(FramePlan& plan);

  Table rows_;
  Block ids_;
  std::vector<std::vector<std::string>> texts_; ///< of each column of texts
  FrameView view_;
};
}
#endif
