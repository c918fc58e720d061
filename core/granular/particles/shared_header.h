// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_shared_header_h
#define granular_particles_shared_header_h

#include "granular/parallel/communicator.h"
#include "granular/particles/frame_view.h"

namespace granular
{
/// Gives ranks without rows, whose frame may know nothing, what the first rank that has rows knows of it: header,
/// box, and what points are. Where none has rows, what the first one knows that has a box. Throws Error, on all,
/// where ranks with rows have other boxes. Collective.
void share_header(FrameView& frame, Communicator& ranks);
}
#endif
