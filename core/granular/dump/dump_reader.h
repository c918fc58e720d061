// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_dump_reader_h
#define granular_dump_dump_reader_h

#include "granular/base/block.h"
#include "granular/base/byte_source.h"
#include "granular/base/error.h"
#include "granular/base/progress.h"
#include "granular/dump/frame.h"
#include "granular/dump/frame_index.h"
#include "granular/dump/positions.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// What of a frame is wanted.
struct DumpRequest
{
  Coordinates coordinates = Coordinates::Absolute;
  bool single_precision = false; ///< points as float instead of double
  Vector3 point_origin = {};     ///< subtracted from the points in double before any rounding
  bool sort_by_id = false;
  std::int64_t stride = 1; ///< >= 1; n keeps id mod n = 0, or every n-th row without ids
  std::array<double, 6> region = { 1, -1, 1, -1, 1, -1 }; ///< xlo xhi ylo yhi zlo zhi, closed, in
    ///< absolute coordinates; an axis with lo > hi is not restricted
  std::function<bool(const ArrayInfo&)> wanted; ///< which arrays; empty: all but position forms
  int piece = 0; ///< the part of the rows that is wanted, of `pieces` in all: see read_dump
  int pieces = 1;
  int threads = 1;                                  ///< >= 1; changes no result
  std::size_t chunk_bytes = std::size_t{ 1 } << 18; ///< of the file that a thread does at a time
};

/// One array of a decoded frame: rows x components values, row-major.
struct DumpArray
{
  ArrayInfo info;
  Block block;                    ///< values; of a Text the std::int32_t indices of its words
  std::vector<std::string> words; ///< of a Text: those that occur, each once
};

/// A decoded frame. The blocks may be given away.
struct DumpFrame
{
  std::int64_t rows = 0;
  Coordinates coordinates = Coordinates::Absolute; ///< what the points are; differs from the
                                                   ///< request only where a notice says so
  Block points;                                    ///< rows x 3, double or float
  std::vector<DumpArray> arrays;
  FrameHeader header;  ///< of the first piece; rows are those of all
  ColumnSchema schema; ///< of all pieces, types as they came to be
};

/// Decodes one frame, text or binary, from all its pieces in their order.
///
/// Reads the rows once, in order, through a buffer of constant size, straight into the blocks;
/// columns that nobody asked for are not parsed. The frame must still be where the index says:
/// a file that was replaced or shortened gives an IoError. Values that an integer column cannot
/// hold turn the whole array into Float64, with a notice.
/// Throws Error with path, line or byte, and column; Cancelled; std::bad_alloc.
DumpFrame read_dump(const std::vector<FramePiece>& pieces, const DumpRequest& request,
  Notices& notices, Progress& progress);

/// The same from an open source, of a frame of one piece.
DumpFrame read_dump(const ByteSource& source, const FrameEntry& entry, const DumpRequest& request,
  Notices& notices, Progress& progress);
}
#endif
