// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_read_dump_part_h
#define granular_formats_dump_read_dump_part_h

#include "granular/common/error.h"
#include "granular/formats/dump/grammar/frame_rows.h"
#include "granular/memory/block.h"
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
}
#endif
