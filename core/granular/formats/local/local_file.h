// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_local_local_file_h
#define granular_formats_local_local_file_h

#include "granular/frames/file_format.h"

#include <string>
#include <string_view>

namespace granular
{
/// Files of dump local, for a RunIndex. They are like text dumps of particles, but count other rows than ATOMS, and may lack
/// the box (LIGGGHTS 2). A `%` in the name of such a dump gives the first rank's file a header for its own rows; the files of
/// other ranks have only rows. These belong to the file with 0 in the same place of the name, if that has one frame. Rows of
/// several frames (a name without `*`) cannot be told apart; these frames are left out with a notice. Files of rows alone
/// (`dump_modify header no`) are a frame each if the user names their columns.
const FileFormat& local_format() noexcept;

/// Returns true if the first bytes of a file, uncompressed, are those of a dump of local data.
bool is_local(std::string_view first_bytes);

/// Returns the same for a file by name, which may be compressed, from its first 64 KiB. Returns false, and never throws, for
/// unreadable files.
bool is_local_file(const std::string& path) noexcept;
}
#endif
