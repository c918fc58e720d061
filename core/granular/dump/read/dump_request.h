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
/// What of a frame is wanted.
struct DumpRequest
{
  Coordinates coordinates = Coordinates::Absolute;
  bool points = true; ///< false: none are made, and coordinates are columns like others
  std::optional<ColumnSchema>
    schema = {}; ///< what the columns are, if they are not what their names say
  std::optional<FrameHeader>
    header = {}; ///< of rows without a header, such as a section of a file; their number is theirs
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

/// What one process has decoded of a frame, before the processes have spoken to each other.
struct DumpPart
{
  DumpFrame frame;
  Block ids;       ///< for sorting, where the frame has no array of them
  Misfits misfits; ///< then there is no frame
  Notices notices;
  RoundingLoss loss;                ///< of the points
  std::vector<std::int64_t> counts; ///< of each piece of the frame, the rows that are in this part
};
}
#endif
