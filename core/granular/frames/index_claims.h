// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_index_claims_h
#define granular_frames_index_claims_h

#include "granular/frames/file_index.h"

namespace granular
{
/// Checks the numbers that an index file claims for a file against the claimed size: places of frames and rows, their
/// order, seek points. Memory allocated for them is then bounded by the size of the file. Throws FormatError.
void check_claims(const FileIndex& file);
}
#endif
