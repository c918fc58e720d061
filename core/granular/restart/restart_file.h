// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_restart_file_h
#define granular_restart_restart_file_h

#include "granular/frames/file_format.h"

#include <string>

namespace granular
{
/// Restart files of LIGGGHTS, for a RunIndex: one frame each, of which the header says the timestep. A file that is not complete
/// is left out with a notice that says what was understood. Files of processes beside their base are passed over.
const FileFormat& restart_format() noexcept;

/// Whether a file is one of these, by content: the first words of the header, in either byte order; also those of LAMMPS, and the files
/// of processes beside their base, so that the user hears why these cannot be read. Never throws: what cannot be read is none.
bool is_restart_file(const std::string& path) noexcept;
}
#endif
