// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_file_format_h
#define granular_dump_file_format_h

#include "granular/base/byte_source.h"
#include "granular/base/progress.h"
#include "granular/base/text_scanner.h"

namespace granular
{
struct FileIndex;

/// What files hold that are indexed frame by frame.
struct FileFormat
{
  const char* name; ///< for messages: "a dump"

  /// Finds the frames from index.resume_offset to the end of the source, see index_dump.
  void (*index)(
    const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead& ahead);

  /// Frames do not say their timestep: it is the number in the name of the file, see name_steps.
  bool steps_in_names = false;
};

/// Dumps of particles.
const FileFormat& dump_format() noexcept;
}
#endif
