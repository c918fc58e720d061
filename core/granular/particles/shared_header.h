// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_shared_header_h
#define granular_particles_shared_header_h

#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

namespace granular
{
/// Gives ranks without rows, whose frame may lack everything, the header, box and form of points of the first rank that has
/// rows. If no rank has rows, the first one with a box counts. Throws Error, on all ranks, if ranks with rows have different
/// boxes. Collective.
void share_header(FrameView& frame, Communicator& ranks);
}
#endif
