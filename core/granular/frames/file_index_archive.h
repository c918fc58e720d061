// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_file_index_archive_h
#define granular_frames_file_index_archive_h

#include "granular/frames/file_index.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Returns the indexes of files as bytes, for other ranks; without errors, layouts and what the user was told.
std::string encode_files(const std::vector<FileIndex>& files);

/// Returns the indexes in the bytes of encode_files, with these kinds. Throws FormatError.
std::vector<FileIndex> decode_files(
  std::string_view bytes, const std::shared_ptr<FrameKinds>& kinds);
}
#endif
