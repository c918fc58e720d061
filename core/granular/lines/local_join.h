// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_lines_local_join_h
#define granular_lines_local_join_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/lines/join.h"
#include "granular/lines/line_rows.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"
#include "granular/particles/request.h"
#include "granular/particles/table.h"

#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// The wanted lines between the particles that rows name.
struct LocalJoinRequest
{
  PeriodicLines periodic_lines = PeriodicLines::MinimumImage;
  std::string averages;    ///< names of particle arrays: see share_names
  std::string differences; ///< the same
  std::string equilibrium_length_array = "equilibrium_length";
  double equilibrium_length = 0; ///< of lines without that array; 0: not known
  std::string timesteps;         ///< what to tell of them: see compare_timesteps
  std::int64_t first_row = 0;    ///< of those that were kept, where each rank has all
  int threads = 1;               ///< at least 1; changes no result
};

/// The joined lines. Lines that are split have several parts; arrays have a value for each line, not for its parts.
struct LocalJoin
{
  Lines lines;
  std::vector<std::int64_t> rows;  ///< that each line is made of; empty: line i is row i
  std::vector<std::int64_t> cells; ///< of the input, for each part; empty: part i is cell i
  std::vector<EndArray>
    arrays; ///< elongation and strain, if lengths at rest are known, then those of the ends
  bool box_of_lines = false;  ///< the particles have none
  std::int64_t first_row = 0; ///< the number of the first row of this rank among all
};

/// Joins the particles and rows that some ranks have together. The particles get the box of the lines where they lack one. Notices tell of
/// rows that are left out, repeated ids, lengths at rest of 0, other timesteps and boxes, and that there is no box. Throws what
/// join_lines and LineRows throw, and Error for a negative or infinite length at rest. Collective.
LocalJoin join_local(FrameView& particles, const LineRows& rows, const LocalJoinRequest& request,
  Communicator& ranks, Notices& notices, PartialProgress& progress);
}
#endif
