// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_history_h
#define granular_paths_history_h

#include "granular/particles/table.h"
#include "granular/paths/path_task.h"

#include <string>

namespace granular
{
/// The wanted columns: see vtkGranularHistory.
struct HistoryRequest
{
  bool statistics = false; ///< of all particles; false: columns of single particles
  std::string quantiles = "0.5";
  bool square_displacement = false;
  int threads = 1; ///< at least 1; changes no result
};

/// Makes a table with a row for each frame of the task, the same on all ranks. Throws Error for other quantiles than numbers from 0 to 1;
/// LimitError for more than 1000 particles; what join_frames throws. Collective.
Table make_history(PathTask& task, const HistoryRequest& request);
}
#endif
