// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_frame_h
#define granular_dump_frame_h

#include "granular/base/box.h"

#include <cstdint>
#include <optional>
#include <string>

namespace granular
{
/// What the header of one frame of a dump says.
struct FrameHeader
{
  std::int64_t timestep = 0;
  std::optional<double> time; ///< ITEM: TIME, in the units of the simulation
  std::string label; ///< ITEM: LABEL, LIGGGHTS' `dump_modify label`: any words of the user's
  std::string units; ///< ITEM: UNITS of this frame or an earlier one of the file
  std::int64_t rows = 0;
  Box box;
};
}
#endif
