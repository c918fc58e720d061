// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_particles_view_frame_h
#define granular_particles_view_frame_h

#include "granular/particles/dump_frame.h"
#include "granular/particles/frame_view.h"

namespace granular
{
/// Returns a view of a decoded frame, without its texts. Points, if there are any, are doubles. The frame must outlive it.
FrameView view_frame(const DumpFrame& frame, const Vector3& point_origin = {});
}
#endif
