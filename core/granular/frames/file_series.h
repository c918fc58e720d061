// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_file_series_h
#define granular_frames_file_series_h

#include "granular/common/error.h"
#include "granular/frames/file_index.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace granular
{
class ArchiveReader;
class ArchiveWriter;

/// What frames of the same timestep in several files are.
enum class RepeatedSteps : std::uint8_t
{
  Auto,  ///< Merge for files that can only be pieces, Last for all others
  Merge, ///< pieces of one frame, one file a process
  Last   ///< repetitions of a restarted run: the last one counts
};

/// The frames of a run, ordered by timestep, and where their pieces are.
class FileSeries
{
public:
  struct Place
  {
    std::uint32_t file;
    std::uint32_t frame; ///< in the file
  };

  /// Auto takes files for pieces (`%` in the name of a dump) if their names, less .gz and .zst,
  /// differ in one number that counts from 0, as the programs count processes; and if these files share
  /// the first timestep and at least half of all, or all that a file has so far, with the same boxes and
  /// columns, but not the same particles, of which the first of some files are looked at. A run that was
  /// restarted does not share the first timestep, a series none, and one that was done again has the same
  /// particles.
  ///
  /// Pieces are in the order of that number; with Merge in the order of the files. A frame that has
  /// not a piece for each number from 0 on, or whose boxes or columns differ, is left out with a
  /// notice; a single one at the end silently if its files are all there, because it is being written.
  FileSeries(const std::vector<FileIndex>& files, RepeatedSteps repeated, Notices& notices);
  FileSeries() = default;

  std::size_t size() const noexcept
  {
    return starts_.empty() ? places_.size() : starts_.size() - 1;
  }

  /// The pieces of a frame, at least one.
  std::span<const Place> pieces(std::size_t frame) const noexcept;

  /// To bytes and back; files are those of before. Throws FormatError.
  void write(ArchiveWriter& out) const;
  static FileSeries read(ArchiveReader& in, const std::vector<FileIndex>& files);

private:
  std::vector<Place> places_;         ///< frame after frame
  std::vector<std::uint32_t> starts_; ///< of the frames in places_, and the end; empty: one each
};
}
#endif
