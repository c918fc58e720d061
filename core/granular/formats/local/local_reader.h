// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_local_local_reader_h
#define granular_formats_local_local_reader_h

#include "granular/formats/dump/read/dump_reader.h"
#include "granular/formats/local/local_presets.h"
#include "granular/lines/lines.h"
#include "granular/parallel/communicator.h"

#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Arrays that make lines, which users see as lines.
bool is_end_array(std::string_view name) noexcept;

/// Returns some rows of a run, from the frame with most of them, to find out the meaning of the columns. `kind` of frames.
LocalSample read_sample(const RunIndex& index, const FrameKind& kind, Progress& progress);

/// Decodes a frame, like read_dump; columns: a name for each of the file, see find_columns. Collective. The positions of the ends are not
/// among the usual arrays. Ids that are not integers are an error. A notice counts ids that were printed
/// with an exponent and so lost digits; another one counts lines whose length differs from the column `dist`.
Table read_local(const std::vector<FramePiece>& pieces, const std::vector<std::string>& columns,
  const Request& request, Communicator& ranks, Notices& notices, Progress& progress);
}
#endif
