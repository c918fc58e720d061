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
/// Calls update_file_index for each of many files, on several threads. Each thread takes one file at a time; if there
/// are fewer files than threads, they share large frames. Seek points are kept for the first compressed files, as far
/// as memory allows; frames of other compressed files are read from the beginning of the file. After an exception the files
/// are unusable.
void update_files(std::vector<FileIndex>& files, const std::vector<std::string>& column_names,
  int threads, Progress& progress, std::size_t most_seek_bytes = std::size_t{ 1 } << 28);
}
#endif
