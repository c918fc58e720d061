// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_run_index_h
#define granular_frames_run_index_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/frames/file_index.h"
#include "granular/frames/frame_times.h"
#include "granular/frames/saved_index.h"
#include "granular/parallel/communicator.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
struct FileSeries;

/// What frames of the same timestep in several files are.
///
/// Auto takes files for pieces (`%` in the name of a dump) if their names, less .gz and .zst,
/// differ in one number that counts from 0, as the programs count processes; and if these files share
/// the first timestep and at least half of all, or all that a file has so far, with the same boxes and
/// columns, but not the same particles, of which the first of some files are looked at. A run that was
/// restarted does not share the first timestep, a series none, and one that was done again has the same
/// particles.
///
/// Pieces are in the order of that number; with Merge in the order of the files. A frame that has
/// not a piece for each number from 0 on, or whose boxes or columns differ, is left out with a
/// notice; a single one at the end silently if its files are all there, because it is being written.
enum class RepeatedSteps : std::uint8_t
{
  Auto,  ///< Merge for files that can only be pieces, Last for all others
  Merge, ///< pieces of one frame, one file a process
  Last   ///< repetitions of a restarted run: the last one counts
};

/// What is the user's word.
struct IndexOptions
{
  const FileFormat* format = nullptr;         ///< of the files; must be there
  std::vector<std::string> column_names = {}; ///< of binary files that do not name their columns
  RepeatedSteps repeated_steps = RepeatedSteps::Auto;
  KeepIndex keep_index = KeepIndex::Never;
  int threads = 1; ///< >= 1; what is found does not depend on it
};

/// A piece of a frame: all of it, or what one process wrote.
struct FramePiece
{
  const FileIndex& file;
  const FrameEntry& entry;
  const ByteSource* source = nullptr; ///< the content of the file, if it is open already
};

/// Returns the content of the file of a piece: see open_indexed.
std::shared_ptr<const ByteSource> open_piece(const FramePiece& piece);

Where where_of(const FramePiece& piece);

/// All complete frames of a run, dumps or other files, found at scan speed without decoding rows.
///
/// Frames are ordered by timestep. Where a timestep is repeated the frames are pieces of one, or the
/// one that stands last is taken, in the order of the files and in its file: see RepeatedSteps. A last
/// frame that is not complete is left out: its writer is still at work. Frames in the middle that are
/// not what their header says are left out with a notice. Files with `boundingBox` in their names,
/// which LIGGGHTS writes beside some dumps, and index files are passed over.
class RunIndex
{
public:
  /// Brings the index up to what the files hold now. Files that only grew are read from where the
  /// last complete frame ended; files that are the same are not read; others are read anew.
  /// notices gets what is to be said of the files that were read now, and of those that cannot be.
  /// Throws IoError or FormatError if no file yields a frame, saying what is wrong with the first;
  /// Cancelled.
  void update(const std::vector<std::string>& files, const IndexOptions& options, Notices& notices,
    Progress& progress);

  /// Whether a file is not what it was at the last update, to judge by size, time and inode.
  bool changed() const;

  std::size_t size() const noexcept;
  const std::vector<FileIndex>& files() const noexcept { return files_; }

  /// The pieces of a frame, at least one. Valid until the next update.
  std::vector<FramePiece> pieces(std::size_t frame) const;

  /// The first piece of a frame.
  FramePiece first_piece(std::size_t frame) const;

  /// Returns the time of every frame [s]: ITEM: TIME if every frame has one and it strictly increases, else timestep x
  /// timestep_size; see frame_times, which has the notices, too. Throws Error where timestep_size makes a time infinite.
  std::vector<double> times(double timestep_size, Notices& notices) const;
  std::vector<double> times(double timestep_size) const;

  /// The last frame at or before a time, of times that increase; the first if there is none.
  /// A time that misses a frame by less than 1e-9 of the way to it is meant to be its own: a product of doubles may be a
  /// little less than the time of a frame.
  static std::size_t find(const std::vector<double>& times, double time) noexcept;

  /// All that is needed to read every frame elsewhere, as bytes; not what is wrong with files.
  std::string encode() const;

  /// Becomes the index that was encoded. Throws FormatError.
  void decode(std::string_view bytes);

private:
  friend void update_run_index(RunIndex& index, Communicator& ranks,
    const std::vector<std::string>& files, const IndexOptions& options, Notices& notices,
    Progress& progress);

  void update_files(const std::vector<std::string>& files, const IndexOptions& options,
    Notices& notices, Progress& progress);
  void note_files(Notices& notices) const;
  void note_times(Notices& notices) const;
  std::vector<FrameInstant> instants() const;
  [[noreturn]] void fail(const Notices& notices) const;

  std::vector<FileIndex> files_;
  std::string kept_;                         ///< path of the index file
  std::shared_ptr<const FileSeries> series_; ///< null: no frames
  std::uint64_t shared_ = 0;                 ///< hash of the bytes that all ranks have, 0: none
};

/// Collective: RunIndex::update on rank 0, which alone looks at files, has notices and reports; then
/// all ranks have the same index. Throws the same on all, and then their indexes have no frames.
void update_run_index(RunIndex& index, Communicator& ranks, const std::vector<std::string>& files,
  const IndexOptions& options, Notices& notices, Progress& progress);

/// Collective: RunIndex::changed on rank 0, for all.
bool is_changed(const RunIndex& index, Communicator& ranks);
}
#endif
