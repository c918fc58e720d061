// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_change_h
#define granular_paths_change_h

#include <cstdint>

namespace granular
{
/// The change of a particle or line from a reference frame to the current frame.
enum class Change : std::int32_t
{
  Kept = 0, ///< in both frames
  New = 1,  ///< in the current frame only
  Lost = 2  ///< in the reference frame only
};
}
#endif
