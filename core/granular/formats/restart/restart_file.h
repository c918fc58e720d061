// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_restart_restart_file_h
#define granular_formats_restart_restart_file_h

#include "granular/formats/restart/restart_layout.h"
#include "granular/frames/file_index.h"

#include <memory>
#include <string>

namespace granular
{
/// Restart files of LIGGGHTS, for a RunIndex: one frame each, with the timestep of the header. An incomplete file is left out
/// with a notice about the parts that were understood. Files of ranks beside their base are skipped.
const FileFormat& restart_format() noexcept;

/// Returns the known layout of a file, or reads it; the notices are the same. Throws the errors of read_layout.
std::shared_ptr<const RestartLayout> find_restart_layout(
  const FileIndex& file, const ByteSource& source, Notices& notices, Progress& progress);

/// Returns true if the contents of a file are a restart file: the first words of the header, in either byte order. Also true
/// for LAMMPS' files and for files of ranks beside their base, so that the user learns why they cannot be read. Returns
/// false, and never throws, for unreadable files.
bool is_restart_file(const std::string& path) noexcept;
}
#endif
