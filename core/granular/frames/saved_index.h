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
/// Where the index of a run is kept between openings.
enum class KeepIndex : std::uint8_t
{
  Never,
  Cache, ///< in the user's cache folder: $XDG_CACHE_HOME/granular, or ~/.cache/granular
  Beside ///< beside the first file: its name and ".granular.idx"
};

/// What the name of every index file ends in.
inline constexpr std::string_view index_file_suffix = ".granular.idx";

/// The path of the index file for a run whose first file is given. Empty: there is none, because
/// of Never, or because the user has no folder for it.
std::string index_file_path(KeepIndex where, const std::string& first_file);

/// The files that are described there, marked as loaded: whether they are still what they were is
/// for update_file_index to see. A file that is not there is no news; one that is damaged, or made
/// by another version of this library, yields nothing and a notice. kinds will be shared by all.
/// Files below the folder of the first one when they were saved are below it now: a folder may be
/// moved with its index. Their paths begin with it as first_file spells it.
std::vector<FileIndex> load_index(const std::string& path, const std::string& first_file,
  const std::shared_ptr<FrameKinds>& kinds, Notices& notices);

/// Writes the index file, whole or not at all; says so in a notice if that fails. Makes the folder
/// of the cache. Where no file has a frame there is nothing to keep, and nothing is written. Files
/// with an error are left out: they are read again next time.
void save_index(const std::string& path, const std::vector<FileIndex>& files, Notices& notices);

/// The content of an index file: all files but those with an error, which are read again next time.
std::string encode_index(const std::vector<FileIndex>& files);

/// The same of all files, with their paths as they are.
std::string encode_files(const std::vector<FileIndex>& files);

/// The files in the content of an index file; see load_index; of encode_files, where first_file is empty. Throws FormatError;
/// UnsupportedError if it is of another version.
std::vector<FileIndex> decode_index(
  std::string_view bytes, const std::string& first_file, const std::shared_ptr<FrameKinds>& kinds);
}
#endif
