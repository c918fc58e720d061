// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_local_file_h
#define granular_local_local_file_h

#include "granular/frames/file_format.h"

#include <string>
#include <string_view>

namespace granular
{
/// The files of dump local, for a RunIndex: as text dumps of particles, but something else than ATOMS is counted, and
/// there need be no box (LIGGGHTS 2). A `%` in the name of such a dump gives the first process a header, of its own rows,
/// and the others files of rows alone: these belong to the file whose name has 0 in the same place, if that has one
/// frame; rows of several frames (a name without `*`) cannot be told apart: these frames are left out with a notice.
const FileFormat& local_format() noexcept;

/// Whether the first bytes of a file, uncompressed, are those of a dump of local data.
bool is_local(std::string_view first_bytes);

/// The same of a file by name, which may be compressed: looks at its first 64 KiB. Never throws: what cannot be
/// read is none.
bool is_local_file(const std::string& path) noexcept;
}
#endif
