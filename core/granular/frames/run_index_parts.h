// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_run_index_parts_h
#define granular_frames_run_index_parts_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/frames/file_index.h"
#include "granular/frames/run_index.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
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

/// Calls update_file_index for each of many files, on several threads. Each thread takes one file at a time; if there
/// are fewer files than threads, they share large frames. Seek points are kept for the first compressed files, as far
/// as memory allows; frames of other compressed files are read from the beginning of the file. After an exception the files
/// are unusable.
void update_files(std::vector<FileIndex>& files, const std::vector<std::string>& column_names,
  int threads, Progress& progress, std::size_t most_seek_bytes = std::size_t{ 1 } << 28);

/// Returns the indexes of files as bytes, for other ranks; without errors, layouts and what the user was told.
std::string encode_files(const std::vector<FileIndex>& files);

/// Returns the indexes in the bytes of encode_files, with these kinds. Throws FormatError.
std::vector<FileIndex> decode_files(
  std::string_view bytes, const std::shared_ptr<FrameKinds>& kinds);
}
#endif
