// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_dump_grammar_dump_files_h
#define granular_formats_dump_grammar_dump_files_h

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

/// Returns true if the first bytes of a file, uncompressed, are those of a dump of particles that index_dump can read.
bool is_dump(std::string_view first_bytes);

/// Returns the same for a file by name, which may be compressed, from its first 64 KiB. Returns false, and never throws, for
/// unreadable files.
bool is_dump_file(const std::string& path) noexcept;

/// FileFormat::index for dumps, text or binary: finds the frames from index.resume_offset on. An incomplete last frame is
/// left out silently, a frame in the middle that contradicts its header with a notice. Several threads skip large frames of a
/// text. Throws IoError, LimitError; FormatError for compressed data; Cancelled.
void index_dump(
  const ByteSource& source, FileIndex& index, Progress& progress, const ScanAhead& ahead = {});
}
#endif
