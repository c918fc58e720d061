// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_dump_reader_h
#define granular_dump_dump_reader_h

#include "granular/base/block.h"
#include "granular/base/byte_source.h"
#include "granular/base/communicator.h"
#include "granular/base/error.h"
#include "granular/base/progress.h"
#include "granular/base/rounding_loss.h"
#include "granular/base/value_range.h"
#include "granular/dump/frame.h"
#include "granular/dump/frame_index.h"
#include "granular/dump/frame_rows.h"
#include "granular/dump/positions.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// What of a frame is wanted.
struct DumpRequest
{
  Coordinates coordinates = Coordinates::Absolute;
  bool points = true; ///< false: none are made, and coordinates are columns like others
  std::optional<ColumnSchema>
    schema = {};                 ///< what the columns are, if they are not what their names say
  bool single_precision = false; ///< points as float instead of double
  Vector3 point_origin = {};     ///< subtracted from the points in double before any rounding
  bool sort_by_id = false;
  std::int64_t stride = 1; ///< >= 1; n keeps id mod n = 0, or every n-th row without ids
  std::array<double, 6> region = { 1, -1, 1, -1, 1, -1 }; ///< xlo xhi ylo yhi zlo zhi, closed, in
    ///< absolute coordinates; an axis with lo > hi is not restricted
  std::function<bool(const ArrayInfo&)>
    wanted;            ///< which arrays: see is_wanted; empty: all but position forms
  bool ranges = false; ///< whether to find the ranges of points and arrays on the way
  int piece = 0;       ///< the part of the rows that is wanted, of `pieces` in all: see read_dump
  int pieces = 1;
  int threads = 1;                                  ///< >= 1; changes no result
  std::shared_ptr<BlockPool> pool;                  ///< where the memory comes from; may be null
  std::size_t chunk_bytes = std::size_t{ 1 } << 18; ///< of the file that a thread does at a time
};

/// Whether an array is wanted: by its own name, or by that of the vector that its columns would be if none of them
/// held texts, which is what a user could choose before the texts were met.
bool is_wanted(const std::function<bool(const ArrayInfo&)>& wanted, const ArrayInfo& array);

/// One array of a decoded frame: rows x components values, row-major.
struct DumpArray
{
  ArrayInfo info;
  Block block;                    ///< values; of a Text the std::int32_t indices of its words
  std::vector<std::string> words; ///< of a Text: those that occur, each once
  ValueRange range;               ///< of the values, if it is known
};

/// A decoded frame. The blocks may be given away.
struct DumpFrame
{
  std::int64_t rows = 0;
  Coordinates coordinates = Coordinates::Absolute; ///< what the points are; differs from the
                                                   ///< request only where a notice says so
  Block points;                                    ///< rows x 3, double or float
  ValueRange points_range;
  std::vector<DumpArray> arrays;
  FrameHeader header;  ///< of the first piece; rows are those of all
  ColumnSchema schema; ///< of all pieces, types as they came to be
};

/// What one process has decoded of a frame, before the processes have spoken to each other.
struct DumpPart
{
  DumpFrame frame;
  Block ids;                   ///< for sorting, where the frame has no array of them
  std::vector<Misfit> misfits; ///< of the first row that has any; then there is no frame
  Notices notices;
  RoundingLoss loss;                ///< of the points
  std::vector<std::int64_t> counts; ///< of each piece of the frame, the rows that are in this part
};

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
