// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_dump_frame_h
#define granular_particles_dump_frame_h

#include "granular/columns/column.h"
#include "granular/frames/frame.h"
#include "granular/geometry/positions.h"
#include "granular/memory/block.h"
#include "granular/memory/value_range.h"
#include "granular/particles/frame_view.h"

#include <cstddef>
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

/// The ranges of the points and of each array of a frame, found part by part. Texts have none.
class FrameRanges
{
public:
  /// Begins with no rows of a frame.
  explicit FrameRanges(const DumpFrame& frame);

  /// Includes rows of a frame with such arrays. single: its points are floats.
  void add(const DumpFrame& frame, std::int64_t first, std::size_t rows, bool single = false);
  void add(const FrameRanges& other);

  /// Gives the ranges to the frame.
  void store(DumpFrame& frame) const;

private:
  ValueRange points_ = ValueRange(3);
  std::vector<ValueRange> arrays_;
};

/// Returns a view of a decoded frame, without its texts. Points, if there are any, are doubles. The frame must outlive it.
FrameView view_frame(const DumpFrame& frame, const Vector3& point_origin = {});
}
#endif
