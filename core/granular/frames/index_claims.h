// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_index_claims_h
#define granular_frames_index_claims_h

#include "granular/frames/file_index.h"

#include <memory>

namespace granular
{
/// Checks the numbers that an index file claims for a file against the claimed size: places of frames and rows, their
/// order, seek points. Memory allocated for them is then bounded by the size of the file. Throws FormatError.
void check_claims(const FileIndex& file);

/// Returns seek points to which no reader adds any. In an index they mean that a compressed file ends with its frame, which who reads
/// it finds out.
std::shared_ptr<SeekPoints> no_points();

/// Returns true if the seek points of an index are no_points().
bool claims_end(const FileIndex& index) noexcept;
}
#endif
