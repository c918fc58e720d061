// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_named_steps_h
#define granular_frames_named_steps_h

#include "granular/frames/file_index.h"

#include <vector>

namespace granular
{
/// Gives the frames of files that do not say their timestep (see FileFormat) one: the last number in the name of
/// the file, of those that differ between files whose names differ in numbers only, but not one that counts its
/// pieces; frames of a file with several, and of one without a number, are counted from 0.
///
/// A number counts pieces if it counts from 0 without gaps, as far for each value of the others, and if there are several
/// of these, or the files are pieces by what is in them: frames with a shape other than FrameEntry::whole, or no
/// frame in any but the first. With a notice for frames that are counted in several files.
void name_steps(std::vector<FileIndex>& files, Notices& notices);
}
#endif
