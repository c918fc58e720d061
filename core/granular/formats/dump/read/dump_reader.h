// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_read_dump_reader_h
#define granular_formats_dump_read_dump_reader_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/formats/dump/grammar/frame_rows.h"
#include "granular/frames/run_index.h"
#include "granular/memory/block.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/request.h"
#include "granular/particles/rounding_loss.h"
#include "granular/particles/table.h"

#include <cstdint>
#include <vector>

namespace granular
{
/// The part of a frame that one rank has decoded, before the ranks communicate.
struct DumpPart
{
  Table frame;
  Block ids;       ///< for sorting, if the frame has no array of ids
  Misfits misfits; ///< if not empty, there is no frame
  Notices notices;
  RoundingLoss loss;                ///< of the points
  std::vector<std::int64_t> counts; ///< rows of each piece in this part
};

/// Decodes one frame, text or binary, from all its pieces in order, or part request.piece of request.pieces of it. The parts
/// hold each row once, in order. A part of a text holds the rows that begin in its share of the bytes, a part of a binary
/// dump or of sorted rows a share of the rows. There may be more parts than rows.
///
/// Reads the rows once, on several threads, straight into the blocks, and a second time if values do not fit the types of
/// their columns. Unwanted columns are not parsed. Compressed files are decompressed in order, while earlier rows are
/// decoded. Result, notices and errors do not depend on the number of threads: the first error by position counts. The frame
/// must still be where the index says: a file that was replaced or shortened gives an IoError. A value that does not fit an
/// integer column turns the whole array into Float64, with a notice. Throws Error with path, line or byte, and column;
/// Cancelled; std::bad_alloc.
Table read_dump(const std::vector<FramePiece>& pieces, const Request& request, Notices& notices,
  Progress& progress);

/// Decodes one frame by all ranks together, each its own part: request.piece is the rank, request.pieces the number of ranks.
/// Collective, except for the decoding itself. All ranks get the notices of all, and throw the errors of any: see agree.
Table read_dump(const std::vector<FramePiece>& pieces, const Request& request, Communicator& ranks,
  Notices& notices, Progress& progress);

/// The non-collective part of read_dump. together: for the ranks.
DumpPart decode_dump(
  const std::vector<FramePiece>& pieces, const Request& request, bool together, Progress& progress);
}
#endif
