// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_index_bytes_h
#define granular_frames_index_bytes_h

#include "granular/frames/file_index.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The content of an index file: all files but those with an error, which are read again next time.
std::string encode_index(const std::vector<FileIndex>& files);

/// The same of all files, with their paths as they are.
std::string encode_files(const std::vector<FileIndex>& files);

/// The files in the content of an index file; see load_index; of encode_files,
/// where first_file is empty. Throws FormatError; UnsupportedError
/// if it is of another version.
std::vector<FileIndex> decode_index(
  std::string_view bytes, const std::string& first_file, const std::shared_ptr<FrameKinds>& kinds);
}
#endif
