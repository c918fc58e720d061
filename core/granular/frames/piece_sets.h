// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_piece_sets_h
#define granular_frames_piece_sets_h

#include "granular/frames/file_index.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
/// Files that hold pieces of the same frames.
struct PieceSet
{
  std::vector<std::uint32_t> files; ///< in the order of the pieces
  std::size_t expected = 0;         ///< how many pieces a frame has
  std::string missing;              ///< the numbers that no file of the set has
};

/// Returns the sets of files that can only be pieces of the same frames: see RepeatedSteps.
std::vector<PieceSet> find_piece_sets(const std::vector<FileIndex>& files);
}
#endif
