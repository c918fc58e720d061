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
/// The wanted part of a frame of local data.
struct LocalRequest
{
  std::vector<std::string> columns; ///< a name for each column of the file: see find_columns
  std::function<bool(std::string_view name)>
    wanted;          ///< wanted arrays; empty: all but the positions of the ends
  LineRequest lines; ///< also gives the number of threads and the source of the memory
  int piece = 0;     ///< part of the rows, of `pieces` in all: see read_dump
  int pieces = 1;
};

/// A decoded frame of local data: a table, and lines if the rows give the ends.
struct LocalFrame
{
  DumpFrame table = {};   ///< without points
  bool has_lines = false; ///< false: the rows have only the ids of the ends
  Lines lines = {};       ///< of the rows of the table
  std::int64_t first_row =
    0; ///< of this part in the frame, where lines have rows of their own (Split)
};

/// Returns the array of a frame that has a name, or null.
DumpArray* find_array(DumpFrame& frame, std::string_view name);

/// Arrays that make lines, which users see as lines.
bool is_end_array(std::string_view name) noexcept;

/// Returns some rows of a run, from the frame with most of them, to find out the meaning of the columns. `kind` of frames.
LocalSample read_sample(const RunIndex& index, const FrameKind& kind, Progress& progress);

/// Decodes a frame, like read_dump. Collective. Ids that are not integers are an error. A notice counts ids that were printed
/// with an exponent and so lost digits; another one counts lines whose length differs from the column `dist`.
LocalFrame read_local(const std::vector<FramePiece>& pieces, const LocalRequest& request,
  Communicator& ranks, Notices& notices, Progress& progress);
}
#endif
