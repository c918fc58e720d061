// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_file_series_h
#define granular_frames_file_series_h

#include "granular/common/archive.h"
#include "granular/common/error.h"
#include "granular/frames/run_index.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
/// The frames of a run, ordered by timestep, and where their pieces are: the part of a RunIndex that tells them apart.
struct FileSeries
{
  struct Place
  {
    std::uint32_t file;
    std::uint32_t frame; ///< in the file
  };

  std::vector<Place> places;                 ///< frame after frame
  std::vector<std::uint32_t> starts = { 0 }; ///< of the frames in places, and the end

  std::size_t size() const noexcept { return starts.size() - 1; }

  /// The pieces of a frame, at least one.
  std::span<const Place> pieces(std::size_t frame) const noexcept
  {
    return std::span(places).subspan(starts[frame], starts[frame + 1] - starts[frame]);
  }
};

/// Returns the frames of the files in their order; see RepeatedSteps for what is left out with a notice.
FileSeries order_frames(
  const std::vector<FileIndex>& files, RepeatedSteps repeated, Notices& notices);

/// To bytes and back; files are those of before. Throws FormatError.
void write_series(ArchiveWriter& out, const FileSeries& series);
FileSeries read_series(ArchiveReader& in, const std::vector<FileIndex>& files);
}
#endif
