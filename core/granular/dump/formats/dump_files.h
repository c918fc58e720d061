// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_formats_dump_files_h
#define granular_dump_formats_dump_files_h

#include "granular/bytes/byte_source.h"
#include "granular/common/progress.h"
#include "granular/frames/file_format.h"
#include "granular/frames/file_index.h"
#include "granular/text/text_scanner.h"

#include <string>
#include <string_view>

namespace granular
{
/// Dumps of particles.
const FileFormat& dump_format() noexcept;

/// True if the first bytes of a file, uncompressed, are those of a dump of particles that
/// index_dump can read.
bool is_dump(std::string_view first_bytes);

/// The same of a file by name, which may be compressed: looks at its first 64 KiB. Never throws:
/// what cannot be read is no dump.
bool is_dump_file(const std::string& path) noexcept;

/// FileFormat::index of dumps, text or binary: finds the frames from index.resume_offset on. A last frame
/// that is not complete is left out, silently; a frame in the middle that is not what its header
/// says with a notice. Throws IoError, LimitError; FormatError of compressed data; Cancelled. Large frames of a text are passed over by several threads.
void index_dump(
  const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead& ahead = {});

/// FileFormat::fits of dumps: looks at the headers of the first and last frames, and of those whose timestep does not grow.
bool dump_fits(const ByteSource& source, const FileIndex& index);
}
#endif
