// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_read_dump_reader_h
#define granular_dump_read_dump_reader_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/dump/read/dump_request.h"
#include "granular/frames/run_index.h"
#include "granular/parallel/communicator.h"
#include "granular/particles/dump_frame.h"

#include <optional>
#include <vector>

namespace granular
{
/// Decodes one frame, text or binary, from all its pieces in their order, or part request.piece of
/// request.pieces of it. The parts hold each row once, in their order: of a text the rows whose first byte
/// lies in the part's share of the bytes, of a binary dump a share of the rows, of sorted rows a share of
/// these. There may be more parts than rows.
///
/// Reads the rows once, on several threads, straight into the blocks, and again where values do not fit the types of their
/// columns; columns that nobody asked for are not parsed. Compressed files are decompressed in order, while rows that were are decoded. Result,
/// notices and errors do not depend on the number of threads: the first error by position counts. The
/// frame must still be where the index says: a file that was replaced or shortened gives an IoError.
/// Values that an integer column cannot hold turn the whole array into Float64, with a notice.
/// Throws Error with path, line or byte, and column; Cancelled; std::bad_alloc.
DumpFrame read_dump(const std::vector<FramePiece>& pieces, const DumpRequest& request,
  Notices& notices, Progress& progress);

/// The same from an open source, of a frame of one piece.
DumpFrame read_dump(const ByteSource& source, const FrameEntry& entry, const DumpRequest& request,
  Notices& notices, Progress& progress);

/// The same by all ranks together, each its own part: request.piece is the rank, request.pieces their
/// number. Collective, but for the decoding itself. Notices of all ranks are on all; errors, also those
/// of one rank alone, are thrown on all: see agree. ahead may be what decode_dump gave for the same
/// request before, and is used up.
DumpFrame read_dump(const std::vector<FramePiece>& pieces, const DumpRequest& request,
  Communicator& ranks, std::optional<DumpPart> ahead, Notices& notices, Progress& progress);

/// What of that a process can do alone, and ahead of time, in any thread. together: for the ranks.
DumpPart decode_dump(const std::vector<FramePiece>& pieces, const DumpRequest& request,
  bool together, Progress& progress);
}
#endif
