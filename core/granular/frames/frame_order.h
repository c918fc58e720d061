// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_frame_order_h
#define granular_frames_frame_order_h

#include "granular/common/archive.h"
#include "granular/common/error.h"
#include "granular/frames/file_index.h"
#include "granular/frames/run_index.h"

#include <cstddef>
#include <cstdint>
#include <span>
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

/// The frames of a run, ordered by timestep, and the places of their pieces: the part of a RunIndex that distinguishes
/// runs.
struct FrameOrder
{
  struct Place
  {
    std::uint32_t file;
    std::uint32_t frame; ///< in the file
  };

  std::vector<Place> places;                 ///< frame after frame
  std::vector<std::uint32_t> starts = { 0 }; ///< of the frames in places, and the end

  std::size_t size() const noexcept { return starts.size() - 1; }

  /// Returns the pieces of a frame, at least one.
  std::span<const Place> pieces(std::size_t frame) const noexcept
  {
    return std::span(places).subspan(starts[frame], starts[frame + 1] - starts[frame]);
  }
};

/// Returns the frames of the files in order; see RepeatedSteps for frames that are left out with a notice.
FrameOrder order_frames(
  const std::vector<FileIndex>& files, RepeatedSteps repeated, Notices& notices);

/// Writes the order to bytes, and reads it back; files must be the same files as before. Throws FormatError.
void write_order(ArchiveWriter& out, const FrameOrder& order);
FrameOrder read_order(ArchiveReader& in, const std::vector<FileIndex>& files);
}
#endif
