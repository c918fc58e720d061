// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_index_claims_h
#define granular_frames_index_claims_h

#include "granular/frames/file_index.h"

namespace granular
{
/// Holds the numbers that an index file says of a file against the size that it says of it: places of frames and rows, their order,
/// seek points. Memory that is made for them is bounded by the bytes of the file then. Throws FormatError.
void check_claims(const FileIndex& file);
}
#endif
