// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_named_steps_h
#define granular_frames_named_steps_h

#include "granular/frames/file_index.h"

#include <vector>

namespace granular
{
/// Gives timesteps to the frames of files that do not contain them (see FileFormat). The timestep is the last number in
/// the name of the file that differs between files whose names differ only in numbers and that does not count pieces.
/// Frames of a file with several frames, or of a file without a number, are numbered from 0.
///
/// A number counts pieces if it runs from 0 without gaps, equally far for each value of the other numbers, and if there
/// are several such numbers, or the contents show that the files are pieces: frames with a shape other than
/// FrameEntry::whole, or no frame in any file but the first. A notice reports frames that are numbered in several
/// files.
void name_steps(std::vector<FileIndex>& files, Notices& notices);
}
#endif
