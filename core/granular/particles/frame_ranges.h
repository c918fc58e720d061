// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_frame_ranges_h
#define granular_particles_frame_ranges_h

#include "granular/particles/dump_frame.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace granular
{
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
}
#endif
