// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_header_archive_h
#define granular_frames_header_archive_h

#include "granular/common/pass.h"
#include "granular/frames/frame.h"

namespace granular
{
/// Archives a header, except its rows.
template <class Archive>
void pass(Archive& archive, typename Archive::template Passed<FrameHeader>& header)
{
  archive.number(header.timestep);
  archive.number(header.time);
  archive.text(header.label);
  archive.text(header.units);
  archive.text(header.counted);
  archive.number(header.has_box);
  archive.number(header.box.origin);
  archive.number(header.box.vectors);
  archive.text(header.box.boundary);
  archive.number(header.box.tilted);
  archive.number(header.box.general);
  archive.number(header.dialect);
  pass(archive, header.digits);
}
}
#endif
