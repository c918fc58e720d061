// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_paths_exchange_frames_h
#define granular_paths_exchange_frames_h

#include "granular/parallel/communicator.h"
#include "granular/paths/path_frame.h"

#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// Gives all ranks the headers of all frames, and the same arrays in each: their sizes and kinds. Frames without particles
/// take what others have. Returns the names of the arrays that no frame with particles has; they are one nan a particle. Throws
/// Error on all ranks if frames differ in the size of an array. Collective.
std::vector<std::string> share_kinds(std::vector<PathFrame>& frames, Communicator& ranks);

/// Throws Error with the first name, if there is any.
void expect_none(const std::vector<std::string>& lacking);

/// Returns the first ids of all ranks but the first, among which particles of such frames are shared evenly: lower ranks have
/// smaller ids. The same on all ranks. Collective.
std::vector<std::int64_t> share_out(const std::vector<PathFrame>& frames, Communicator& ranks);

/// Moves particles to the ranks that have them in all frames. Particles of a frame keep their order: by rank, then as they
/// were. Collective.
void exchange_frames(
  std::vector<PathFrame>& frames, const std::vector<std::int64_t>& first_ids, Communicator& ranks);
}
#endif
