// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_frame_index_h
#define granular_dump_frame_index_h

#include "granular/base/column.h"
#include "granular/base/error.h"
#include "granular/base/progress.h"
#include "granular/dump/frame.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace granular
{
/// Where a frame lies in its file. The rows are the lines of [rows_offset, end).
struct FrameEntry
{
  std::size_t file = 0; ///< index into FrameIndex::files()
  std::int64_t offset = 0;
  std::int64_t rows_offset = 0;
  std::int64_t end = 0;
  std::int64_t line = 1;      ///< line number at offset
  std::int64_t rows_line = 1; ///< line number at rows_offset
  std::uint64_t hash = 0;     ///< of the header and the last rows: tells whether it is still there
  FrameHeader header;
  std::shared_ptr<const ColumnSchema> schema; ///< shared by frames of a file with the same columns
};

/// All complete frames of a run, found at scan speed without decoding rows.
///
/// Frames are ordered by timestep. Where a timestep is repeated (a restarted run) the frame that
/// stands last, in the order of the files and in its file, is taken. A last frame that is not
/// complete is left out: its writer is still at work. Frames in the middle that are not what
/// their header says are left out with a notice.
class FrameIndex
{
public:
  FrameIndex();
  FrameIndex(FrameIndex&&) noexcept;
  FrameIndex& operator=(FrameIndex&&) noexcept;
  ~FrameIndex();

  /// Brings the index up to what the files hold now. Files that only grew are read from where the
  /// last complete frame ended; files that are the same are not read; others are read anew.
  /// notices gets what is to be said of the files that were read now, and of those that cannot be.
  /// Throws IoError or FormatError if no file yields a frame, saying what is wrong with the first;
  /// Cancelled.
  void update(const std::vector<std::string>& files, Notices& notices, Progress& progress);

  const std::vector<FrameEntry>& frames() const noexcept { return frames_; }
  const std::vector<std::string>& files() const noexcept { return paths_; }

  /// Time of every frame [s]: ITEM: TIME if every frame has one and it strictly increases,
  /// else timestep * timestep_size.
  std::vector<double> times(double timestep_size) const;

  /// The last frame at or before a time, of times that increase; the first if there is none.
  /// A time that misses a frame by less than 1e-9 of the way to it is meant to be its own: 0.06 is
  /// 3000 * 2e-5, which is a little more.
  static std::size_t find(const std::vector<double>& times, double time) noexcept;

private:
  struct File;

  static void update_file(
    File& file, const std::string& path, Notices& notices, Progress& progress);
  void collect(Notices& notices);
  void note_hidden_files(Notices& notices) const;
  void note_times(Notices& notices) const;
  std::vector<double> header_times() const;
  [[noreturn]] void fail() const;

  std::vector<std::string> paths_;
  std::vector<File> records_; ///< one a path
  std::vector<FrameEntry> frames_;
};
}
#endif
