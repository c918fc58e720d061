// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_update_files_h
#define granular_frames_update_files_h

#include "granular/common/progress.h"
#include "granular/frames/file_index.h"

#include <cstddef>
#include <string>
#include <vector>

namespace granular
{
/// update_file_index for each of many files, on several threads: each takes one file at a time; where
/// there are fewer files than threads, these share large frames. Seek points are kept for the first
/// compressed files, as far as they fit; reading a frame of the others starts at the beginning of the file.
/// Returns whether anything was read. If this throws, the files are good for nothing.
bool update_files(std::vector<FileIndex>& files, const std::vector<std::string>& column_names,
  int threads, Progress& progress, std::size_t most_seek_bytes = std::size_t{ 1 } << 28);
}
#endif
