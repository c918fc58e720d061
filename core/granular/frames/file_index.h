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
/// A file as it was when it was looked at; the stamp of one that is not there is that of no file.
struct KnownFile
{
  std::string path;
  FileStamp stamp;
};

/// What is known of one dump: its frames, and how to go on when it has grown.
struct FileIndex
{
  std::string path;
  FileStamp stamp;             ///< when it was indexed
  std::uint64_t ends_hash = 0; ///< of its first and last bytes then: see hash_ends
  std::vector<FrameEntry> frames;
  std::vector<KnownFile>
    beside; ///< other files that what is known depends on; set by FileFormat::index
  std::int64_t resume_offset = 0; ///< end of the last complete frame: where to go on
  std::int64_t resume_line = 1;
  std::string units;    ///< of the last ITEM: UNITS; it is printed once a file
  Notices notices;      ///< frames that were left out, and why
  std::size_t told = 0; ///< how many of these the user has had
  std::optional<Notice>
    defect;                 ///< what is wrong with the first frame that was left out, or missing
  std::string unchecked;    ///< see ByteSource::unchecked
  std::exception_ptr error; ///< the file could not be opened or read
  bool unnamed = false;     ///< binary, without the names of its columns
  bool compressed = false;  ///< gzip or Zstandard
  bool loaded = false;      ///< from an index file: to be held against the file first
  std::vector<std::string> column_names; ///< of the user, for such a file
  std::shared_ptr<SeekPoints> points;    ///< of a compressed file
  std::shared_ptr<FrameKinds> kinds;     ///< may be shared by files; made where it is missing
  const FileFormat* format = nullptr;    ///< must be there to be updated
};

/// The first 64 KiB of a file, uncompressed: headers of ordinary length are there many times over, and more is not read to find
/// out what a file is.
std::string first_bytes_of(const ByteSource& source);

/// Returns look(source) of the content of a file, which may be compressed. Never throws: what cannot be read is nothing.
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

/// Brings the index of a file up to what the file holds now: reads nothing if it did not change,
/// goes on if it only grew, and else, or if a file beside it changed, starts anew. Errors end in index.error; data packed in other ways are one.
/// Throws Cancelled.
/// Returns whether anything was read.
bool update_file_index(FileIndex& index, const std::vector<std::string>& column_names,
  Progress& progress, const ScanAhead& ahead = {});

/// Whether the file, or one beside it, is not what it was when it was indexed.
bool is_changed(const FileIndex& index);

/// The state of a file now; of one that cannot be opened, a state that no file has.
FileStamp stamp_of(const std::string& path);

/// Opens the content of a file for reading what the index says. Throws IoError also if the file
/// changed other than by growing.
std::unique_ptr<ByteSource> open_indexed(const FileIndex& index);

/// Hash of the first 4 KiB of a file and of the 4 KiB before a size.
std::uint64_t hash_ends(const ByteSource& packed, std::int64_t size);

/// Sets what is wrong with the file, if nothing was before: what is wrong first is what is said if
/// there is no frame at all.
void set_defect(FileIndex& index, const Notice& defect);
}
#endif
