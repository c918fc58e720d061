// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_saved_index_h
#define granular_frames_saved_index_h

#include "granular/common/error.h"
#include "granular/frames/file_index.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The place where the index of a run is kept between openings.
enum class KeepIndex : std::uint8_t
{
  Never,
  Cache, ///< in the user's cache folder: $XDG_CACHE_HOME/granular, or ~/.cache/granular
  Beside ///< beside the first file: its name and ".granular.idx"
};

/// The ending of every index file's name.
inline constexpr std::string_view index_file_suffix = ".granular.idx";

/// Returns the path of the index file for a run whose first file is given. Empty for Never, and if the user has no
/// cache folder.
std::string index_file_path(KeepIndex where, const std::string& first_file);

/// Returns the files described in an index file, marked as loaded: update_file_index checks whether they are unchanged.
/// A missing index file is normal. A damaged one, or one of another version of this library, yields nothing and a
/// notice. kinds is shared by all files. Paths below the folder of the first file are relative to it: a folder may be
/// moved with its index. They begin with the folder as first_file spells it.
std::vector<FileIndex> load_index(const std::string& path, const std::string& first_file,
  const std::shared_ptr<FrameKinds>& kinds, Notices& notices);

/// Writes the index file completely or not at all; a failure is a notice. Replaces an index, but no link and no other file. Creates
/// the cache folder. If no file has a frame, nothing is written. Files with an error are left out: they are read again next time.
void save_index(const std::string& path, const std::vector<FileIndex>& files, Notices& notices);

/// Returns true if bytes begin as those of an index file, of any version.
bool begins_as_index(std::string_view bytes) noexcept;

/// Returns the content of an index file: all files except those with an error, which are read again next time.
std::string encode_index(const std::vector<FileIndex>& files);

/// Returns the content for all files, with their paths unchanged.
std::string encode_files(const std::vector<FileIndex>& files);

/// Returns the files in the content of an index file (see load_index), or of encode_files if first_file is empty.
/// Throws FormatError; UnsupportedError for another version.
std::vector<FileIndex> decode_index(
  std::string_view bytes, const std::string& first_file, const std::shared_ptr<FrameKinds>& kinds);
}
#endif
