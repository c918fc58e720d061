// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_local_reader_h
#define granular_local_local_reader_h

#include "granular/dump/read/dump_reader.h"
#include "granular/local/lines.h"
#include "granular/local/local_presets.h"
#include "granular/parallel/communicator.h"

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// What of a frame of local data is wanted.
struct LocalRequest
{
  std::vector<std::string> columns; ///< a name for each of the file: see find_columns
  std::function<bool(std::string_view name)>
    wanted;          ///< which arrays; empty: all but the positions of the ends
  LineRequest lines; ///< also what says how many threads there are, and where the memory comes from
  int piece = 0;     ///< the part of the rows that is wanted, of `pieces` in all: see read_dump
  int pieces = 1;
};

/// A decoded frame of local data: a table, and where its rows say where the ends are, lines.
struct LocalFrame
{
  DumpFrame table;        ///< without points
  bool has_lines = false; ///< else the rows have but the ids of the ends
  Lines lines;            ///< of the rows of the table
  std::int64_t first_row =
    0; ///< of this part in the frame, where lines have rows of their own (Split)
};

/// Arrays that make lines, and of which users see lines.
bool is_end_array(std::string_view name) noexcept;

/// Some rows of a run, those of the frame with most of them: to find out what the columns are. `kind` of frames.
LocalSample read_sample(const RunIndex& index, const FrameKind& kind, Progress& progress);

/// Decodes a frame, as read_dump does and by the same means. Collective. Ids that are no integers are an error; such
/// as were printed with an exponent, so that digits are lost, are counted in a notice; so are lines whose column `dist` says that
/// the ends are as far apart as they are not drawn.
LocalFrame read_local(const std::vector<FramePiece>& pieces, const LocalRequest& request,
  Communicator& ranks, Notices& notices, Progress& progress);
}
#endif
