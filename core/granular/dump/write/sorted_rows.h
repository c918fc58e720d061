// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_sorted_rows_h
#define granular_dump_write_sorted_rows_h

#include "granular/dump/write/frame_plan.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/dump_frame.h"

#include <string>
#include <vector>

namespace granular
{
/// The columns of a frame that is to be written, copied and in the order of their ids.
class SortedRows
{
public:
  /// Copies the rows of the view, duplicates left out, as the columns of the plan have them, and gives each rank
  /// its part of the sorted rows of all: see sort_by_id. The plan is that of view() then. The frame must
  /// have ids. Collective.
  SortedRows(const FrameView& frame, FramePlan& plan, Communicator& ranks, const Executor& executor,
    Progress& progress);

  const FrameView& view() const noexcept { return view_; }

private:
  void copy(const FrameView& frame, const FramePlan& plan, int rank, Progress& progress);
  void show(FramePlan& plan);

  DumpFrame rows_;
  Block ids_;
  std::vector<std::vector<std::string>> texts_; ///< of each column of texts
  FrameView view_;
};
}
#endif
