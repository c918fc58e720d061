// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_run_index_h
#define granular_frames_run_index_h

#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/frames/file_index.h"
#include "granular/frames/frame_times.h"
#include "granular/parallel/communicator.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
struct FrameOrder;

/// Meaning of several frames with the same timestep in different files.
///
/// Auto takes files for pieces (`%` in the name of a dump) on three conditions. Their names, without .gz and .zst, differ in
/// one number that counts from 0, like the ranks of a simulation. The files share the first timestep and at least half of all
/// timesteps, or all that a file has so far, with the same boxes and columns. They do not share particles; the first
/// particles of some files are compared. A restarted run does not share the first timestep, a series shares none, and a
/// repeated run has the same particles.
///
/// Pieces are in the order of that number; with Merge in the order of the files. A frame is left out with a notice if it
/// lacks the piece of a number, or if boxes or columns differ. A single incomplete frame at the end is left out silently if
/// all its files exist, because it is being written.
enum class RepeatedSteps : std::uint8_t
{
  Auto,  ///< Merge for files that can only be pieces, otherwise Last
  Merge, ///< pieces of one frame, one file per rank
  Last   ///< repetitions of a restarted run: the last one counts
};

/// Options of the user.
struct IndexOptions
{
  const FileFormat* format = nullptr;         ///< of the files; must be there
  std::vector<std::string> column_names = {}; ///< of binary files that do not name their columns
  RepeatedSteps repeated_steps = RepeatedSteps::Auto;
  int threads = 1; ///< at least 1; does not change the result
};

/// A piece of a frame: the whole frame, or the part of one rank.
struct FramePiece
{
  const FileIndex& file;
  const FrameEntry& entry;
  const ByteSource* source = nullptr; ///< the content of the file, if it is open already
};

/// Returns the content of the file of a piece: see open_indexed.
std::shared_ptr<const ByteSource> open_piece(const FramePiece& piece);

/// Returns the content of a piece, to be read in order by so many threads: see open_indexed.
std::shared_ptr<const ByteSource> open_piece(const FramePiece& piece, int threads);

Where where_of(const FramePiece& piece);

/// The complete frames of a run, of dumps or other files, found at scan speed without decoding rows.
///
/// Frames are ordered by timestep. Frames with the same timestep are pieces, or the last one counts, in the order of the
/// files and within a file: see RepeatedSteps. An incomplete last frame is left out, because it is still being written.
/// Frames in the middle that contradict their header are left out with a notice. Files with `boundingBox` in their
/// names, which LIGGGHTS writes beside some dumps, are skipped.
class RunIndex
{
public:
  /// Updates the index to the current contents of the files. Files that grew are read from the end of the last complete
  /// frame, unchanged files are not read, and other files are read again.
  /// Appends notices about the files that are new here or were read now, and about unreadable files. Throws IoError or
  /// FormatError with the error of the first file if no file yields a frame; Cancelled.
  void update(const std::vector<std::string>& files, const IndexOptions& options, Notices& notices,
    Progress& progress);

  /// Returns true if the size, time or inode of a file has changed since the last update.
  bool changed() const;

  std::size_t size() const noexcept;
  const std::vector<FileIndex>& files() const noexcept { return *files_; }

  /// Returns the pieces of a frame, at least one. Valid until the next update.
  std::vector<FramePiece> pieces(std::size_t frame) const;

  /// Returns the first piece of a frame.
  FramePiece first_piece(std::size_t frame) const;

  /// Returns the time of every frame [s]: ITEM: TIME if every frame has one and it strictly increases, otherwise timestep x
  /// timestep_size. See frame_times for the notices. Throws Error if timestep_size makes a time infinite.
  std::vector<double> times(double timestep_size, Notices& notices) const;
  std::vector<double> times(double timestep_size) const;

  /// Returns the last frame at or before a time, or the first frame; times increase. A time that misses a frame by less than
  /// 1e-9 of the distance to it counts as the frame's own, because a product of doubles may be slightly too small.
  static std::size_t find(const std::vector<double>& times, double time) noexcept;

  /// Returns all that another rank needs to read every frame, as bytes; without the errors of files.
  std::string encode() const;

  /// Restores an encoded index. Throws FormatError.
  void decode(std::string_view bytes);

private:
  friend void update_run_index(RunIndex& index, Communicator& ranks,
    const std::vector<std::string>& files, const IndexOptions& options, Notices& notices,
    Progress& progress);

  /// Returns the files that this does not know.
  std::vector<std::string> unknown_files(const std::vector<std::string>& files) const;
  /// As update, with what other ranks know of files.
  void update(const std::vector<std::string>& files, const IndexOptions& options,
    std::vector<FileIndex>&& of_ranks, Notices& notices, Progress& progress);
  std::vector<FileIndex> update_files(const std::vector<std::string>& files,
    const IndexOptions& options, std::vector<FileIndex>&& of_ranks, Notices& notices,
    Progress& progress);
  /// Returns the kinds of the frames that this knows, or new ones.
  std::shared_ptr<FrameKinds> kinds() const;
  void note_files(Notices& notices) const;
  void note_times(Notices& notices) const;
  std::vector<FrameInstant> instants() const;
  [[noreturn]] void fail(const Notices& notices) const;

  using Files = std::shared_ptr<const std::vector<FileIndex>>;

  Files files_ = std::make_shared<const std::vector<FileIndex>>(); ///< null only after a move
  Files scanned_ = files_; ///< files_ before FileFormat::complete: an update goes on from them
  std::shared_ptr<const FrameOrder> order_; ///< null: no frames
  std::uint64_t shared_ = 0;                ///< hash of the bytes that all ranks have, 0: none
};

/// Updates the index on rank 0, which alone has notices; then all ranks have the same index. If the format has large runs, the ranks
/// share the search in new files, each with its own threads and progress. Rank 0 searches the files that have changed, and those that
/// another rank cannot read or finds different. Options other than threads must be the same on all ranks. Collective. Throws the same error on all ranks, whose indexes then have no frames.
void update_run_index(RunIndex& index, Communicator& ranks, const std::vector<std::string>& files,
  const IndexOptions& options, Notices& notices, Progress& progress);

/// Returns RunIndex::changed of rank 0 on all ranks. Collective.
bool is_changed(const RunIndex& index, Communicator& ranks);
}
#endif
