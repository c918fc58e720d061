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

/// Numbers by which rows of files are compared.
struct FirstRows
{
  std::vector<std::int64_t> keys;
  bool are_ids = false; ///< no two rows have the same; else equal rows have
};

/// What files hold that are indexed frame by frame.
struct FileFormat
{
  const char* name; ///< for messages: "a dump"

  /// Finds the frames from index.resume_offset to the end of the source: frames that are not complete are left out. Lists in
  /// index.beside which other files it has looked at. Throws IoError, LimitError; FormatError of packed data; Cancelled.
  void (*index)(
    const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead& ahead);

  /// Completes what frames do not say by themselves from all files of a run and their names, or null; may be called again
  /// with files that it has completed.
  void (*complete)(std::vector<FileIndex>& files, Notices& notices) = nullptr;

  /// Whether what an index file says of a file with frames can be true, which nothing shows that is looked at when a frame is read.
  /// Looks at little of the source. May throw Error: it cannot be true then.
  bool (*fits)(const ByteSource& source, const FileIndex& index) = nullptr;

  /// What the first row of a frame holds, for who is to name its columns, or null. May throw Error.
  std::string (*describe)(const ByteSource& source, const FrameEntry& entry) = nullptr;

  /// The first rows of a frame, by which pieces are told from repetitions, or null; none where they tell nothing. Throws
  /// IoError.
  FirstRows (*first_rows)(const FileIndex& file, const FrameEntry& entry) = nullptr;

  int layouts = 0; ///< how many FrameKind::layout there are that are no text
};
}
#endif
