// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_data_file_data_file_h
#define granular_formats_data_file_data_file_h

#include "granular/formats/data_file/data_layout.h"
#include "granular/frames/file_index.h"

#include <memory>
#include <string>

namespace granular
{
/// Data files of LAMMPS and LIGGGHTS (read_data, write_data), for a RunIndex: one frame each, with the timestep of the title,
/// or 0.
const FileFormat& data_file_format() noexcept;

/// Returns the known layout of a file, or reads it. Throws the errors of read_data_layout.
std::shared_ptr<const DataLayout> find_data_layout(
  const FileIndex& file, const ByteSource& source, Progress& progress);

/// Returns true if the contents of a file are a title and a header that counts atoms. Looks at the first 64 KiB,
/// decompressed. Returns false, and never throws, for unreadable files.
bool is_data_file(const std::string& path) noexcept;
}
#endif
