// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_file_index_h
#define granular_frames_file_index_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/frames/file_format.h"
#include "granular/frames/frame.h"
#include "granular/text/text_scanner.h"

#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// A file when it was looked at; a missing file has a stamp that no file has.
struct KnownFile
{
  std::string path;
  FileStamp stamp;
};

/// The index of one dump: its frames, and the position to continue when it has grown.
struct FileIndex
{
  std::string path;
  FileStamp stamp;             ///< when it was indexed
  std::uint64_t ends_hash = 0; ///< of its first and last bytes at that time: see hash_ends
  std::vector<FrameEntry> frames;
  std::vector<KnownFile>
    beside; ///< other files that the index depends on; set by FileFormat::index
  std::int64_t resume_offset = 0; ///< end of the last complete frame, where reading continues
  std::int64_t resume_line = 1;
  std::string units;            ///< of the last ITEM: UNITS, which is printed once per file
  Notices notices;              ///< frames that were left out, and why
  std::size_t told = 0;         ///< number of notices that the user has seen
  std::optional<Notice> defect; ///< error of the first frame that was left out or is missing
  std::string unchecked;        ///< see ByteSource::unchecked
  std::exception_ptr error;     ///< the file could not be opened or read
  bool unnamed = false;         ///< binary or rows alone, without the names of its columns
  bool compressed = false;      ///< gzip or Zstandard
  std::vector<std::string> column_names; ///< of the user, for such a file
  std::shared_ptr<SeekPoints> points;    ///< of a compressed file
  std::shared_ptr<FrameKinds> kinds = std::make_shared<FrameKinds>(); ///< may be shared by files
  std::shared_ptr<const FileLayout> layout;                           ///< see known_layout
  const FileFormat* format = nullptr; ///< must be there to be updated
};

/// Returns the first 64 KiB of a file, decompressed: enough for many headers of ordinary length, and all that is read to
/// recognise a file.
std::string first_bytes_of(const ByteSource& source);

/// Returns look(source) of the contents of a file, which may be compressed. Returns false, and never throws, if they cannot
/// be read.
template <class Look>
bool looks_so(const std::string& path, const Look& look) noexcept
{
  try
  {
    return look(*unpack(open_file(path)));
  }
  catch (const std::exception&)
  {
    return false;
  }
}

/// Updates the index of a file to its current contents. Reads nothing if the file is unchanged, continues if it only grew,
/// and otherwise, or if a file beside it changed, starts again. Errors end in index.error, also a changed compression.
/// Throws Cancelled.
void update_file_index(FileIndex& index, const std::vector<std::string>& column_names,
  Progress& progress, const ScanAhead& ahead = {});

/// Makes the index of a file that another rank has looked through one of this machine, where devices and inodes may have other
/// numbers, if the file has the same size, time and ends here.
void adopt(FileIndex& index);

/// Returns true if the file, or one beside it, has changed since it was indexed.
bool is_changed(const FileIndex& index);

/// Returns the layout that was found when a file was indexed. Returns null if there is none of this type, as in an index from
/// bytes, or if the file or one beside it has changed since.
template <class Layout>
std::shared_ptr<const Layout> known_layout(const FileIndex& index)
{
  auto layout = std::dynamic_pointer_cast<const Layout>(index.layout);
  return layout && !is_changed(index) ? layout : nullptr;
}

/// Returns the current state of a file, or a state that no file has if it cannot be opened.
FileStamp stamp_of(const std::string& path);

/// Opens the contents of a file for reading by its index. Throws IoError, also if the file changed other than by growing.
std::unique_ptr<ByteSource> open_indexed(const FileIndex& index);

/// Opens the content of a frame to read it in order. So many threads may read a large one of a compressed file at once: see
/// unpack_segments. The end of the frame may seem to be that of the file. Throws as open_indexed.
std::unique_ptr<ByteSource> open_indexed(
  const FileIndex& index, const FrameEntry& entry, int threads);

/// Returns the hash of the first 4 KiB of a file and of the 4 KiB before a size.
std::uint64_t hash_ends(const ByteSource& packed, std::int64_t size);

/// Forgets the frames of a file that is one frame, and read as a whole whatever was there before.
void forget_frames(FileIndex& index);

/// Adds the frame of such a file.
void add_whole(FileIndex& index, FrameEntry entry, std::shared_ptr<const FileLayout> layout);

/// Leaves out a file with a defect, which a notice tells.
void leave_out(FileIndex& index, const Error& error);

/// Sets the defect of a file unless it has one: the first defect is reported if there is no frame at all.
void set_defect(FileIndex& index, const Notice& defect);
}
#endif
