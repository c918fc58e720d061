// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_dump_frame_h
#define granular_particles_dump_frame_h

#include "granular/columns/column.h"
#include "granular/frames/frame.h"
#include "granular/geometry/positions.h"
#include "granular/memory/block.h"
#include "granular/memory/value_range.h"

#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// One array of a decoded frame: rows x components values, row-major.
struct DumpArray
{
  ArrayInfo info;
  Block block;                    ///< values; of a Text the std::int32_t indices of its words
  std::vector<std::string> words; ///< of a Text: the distinct words
  ValueRange range;               ///< of the values, if known
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
  FrameHeader header;  ///< of the first piece; rows of all
  ColumnSchema schema; ///< of all pieces, with the final types
};
}
#endif
