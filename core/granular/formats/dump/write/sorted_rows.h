// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_write_sorted_rows_h
#define granular_formats_dump_write_sorted_rows_h

#include "granular/formats/dump/write/frame_plan.h"
#include "granular/parallel/communicator.h"
#include "granular/parallel/executor.h"
#include "granular/particles/table.h"

#include <string>
#include <vector>

namespace granular
{
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
