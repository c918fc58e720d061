// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_read_dump_request_h
#define granular_dump_read_dump_request_h

#include "granular/columns/column.h"
#include "granular/common/error.h"
#include "granular/dump/formats/frame_rows.h"
#include "granular/geometry/positions.h"
#include "granular/memory/block.h"
#include "granular/particles/dump_frame.h"
#include "granular/particles/rounding_loss.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace granular
{
/// The wanted part of a frame.
struct DumpRequest
{
  Coordinates coordinates = Coordinates::Absolute;
  bool points = true; ///< false: no points, and coordinates are columns like others
  std::optional<ColumnSchema>
    schema = {}; ///< meaning of the columns, if their names do not give it
  std::optional<FrameHeader>
    header = {}; ///< header for rows without one, such as a section of a file; rows are counted
  bool single_precision = false; ///< points as float instead of double
  Vector3 point_origin = {};     ///< subtracted from the points in double before any rounding
  bool sort_by_id = false;
  std::int64_t stride = 1; ///< at least 1; n keeps id mod n = 0, or every n-th row without ids
  std::array<double, 6> region = { 1, -1, 1, -1, 1, -1 }; ///< xlo xhi ylo yhi zlo zhi, closed, in
    ///< absolute coordinates; an axis with lo > hi is not restricted
  std::function<bool(std::int64_t)>
    keep_id = {}; ///< particles to keep, by id; called on any thread; empty: all. Without ids none is kept
  std::function<bool(const ArrayInfo&)>
    wanted;            ///< wanted arrays, see is_wanted; empty: all but position forms
  bool ranges = false; ///< true: find the ranges of points and arrays while decoding
  int piece = 0;       ///< part of the rows, of `pieces` in all: see read_dump
  int pieces = 1;
  int threads = 1;                                  ///< at least 1; changes no result
  std::shared_ptr<BlockPool> pool;                  ///< source of the memory; may be null
  std::size_t chunk_bytes = std::size_t{ 1 } << 18; ///< of the file, decoded by a thread at a time
};

/// Returns true if an array is wanted: by its own name, or by that of the vector that its columns would form if none held
/// texts. A user could only choose that vector before the texts were seen.
bool is_wanted(const std::function<bool(const ArrayInfo&)>& wanted, const ArrayInfo& array);

/// The part of a frame that one rank has decoded, before the ranks communicate.
struct DumpPart
{
  DumpFrame frame;
  Block ids;       ///< for sorting, if the frame has no array of ids
  Misfits misfits; ///< if not empty, there is no frame
  Notices notices;
  RoundingLoss loss;                ///< of the points
  std::vector<std::int64_t> counts; ///< rows of each piece in this part
};
}
#endif
