// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_file_format_h
#define granular_frames_file_format_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/text/text_scanner.h"

#include <cstdint>
#include <string>
#include <vector>

namespace granular
{
struct FileIndex;
struct FrameEntry;

/// The positions of the parts of a file that is one frame, for its reader. Formats derive their own.
struct FileLayout
{
  virtual ~FileLayout() = default;
};

/// The operations on a file format whose files are indexed frame by frame.
struct FileFormat
{
  const char* name; ///< for messages: "a dump"

  /// Finds the frames from index.resume_offset to the end of the source; incomplete frames are left out. Lists the
  /// other files that it examined in index.beside, and may set index.layout. Throws IoError, LimitError; FormatError for
  /// compressed data; Cancelled.
  void (*index)(
    const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead& ahead);

  /// Completes frames that lack information from all files of a run and their names; may be null. May be called again
  /// with files that it has completed.
  void (*complete)(std::vector<FileIndex>& files, Notices& notices) = nullptr;

  /// Returns true if frames lack what complete gives them; null: they always do.
  bool (*lacks)(const std::vector<FileIndex>& files) = nullptr;

  /// Returns a description of the first row of a frame, for a user who has to name its columns; may be null. May throw
  /// Error.
  std::string (*describe)(const ByteSource& source, const FrameEntry& entry) = nullptr;

  /// Returns numbers of the first rows of a frame that no other piece of it has, which tells pieces from repetitions; none if
  /// they tell nothing; may be null. May throw Error.
  std::vector<std::int64_t> (*first_rows)(const FileIndex& file, const FrameEntry& entry) = nullptr;

  bool reads_vtk = false; ///< says itself which VTK files it cannot read
  bool names_pieces =
    false; ///< names alone tell pieces: RepeatedSteps::Merge says so of a number that counts from 0
  bool reads_all = false; ///< says itself of all files, which are not looked at before
  bool large_runs =
    false; ///< of so many or large files that several ranks look through them together
};
}
#endif
