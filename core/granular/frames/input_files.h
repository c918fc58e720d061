// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_input_files_h
#define granular_frames_input_files_h

#include "granular/bytes/byte_sink.h"
#include "granular/frames/run_index.h"

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace granular
{
class Communicator;

/// The files that are read while others are written. Device and inode tell them apart: links and spellings give a file many
/// names.
class InputFiles
{
public:
  /// Adds the files of a run.
  void add(const RunIndex& index);

  /// Returns true if a name leads to one of the files. Throws Error if that file may not be replaced: a frame of it is not
  /// complete, so a simulation may be writing it, or other files have the rest of its frames.
  bool has(const std::string& path) const;

private:
  struct Run
  {
    RunIndex index;
    std::optional<std::set<const FileIndex*>>
      pieces; ///< see find_pieces; found when they are needed
  };

  mutable std::vector<Run> runs_;
};

/// New files that replace files that are still read: they get their names last. Without a call of finish_all() they are
/// removed.
class HeldFiles
{
public:
  /// inputs: null for none, on all ranks; must outlive this object.
  explicit HeldFiles(const InputFiles* inputs)
    : inputs_(inputs)
  {
  }

  /// Returns true, on all ranks, if the file that one of them is to write is one that is read. Throws what InputFiles::has
  /// throws. Collective.
  bool is_read(const std::string& path, Communicator& ranks) const;

  /// Gives a file its name, now or in finish_all(). Returns true if the file has its name. Throws IoError, and the errors of
  /// InputFiles::has.
  bool finish(std::unique_ptr<NewFile> file, bool durable);

  /// Gives all files their names, or none if another writer has taken one of them away. Throws IoError.
  void finish_all(bool durable);

private:
  const InputFiles* inputs_;
  std::vector<std::unique_ptr<NewFile>> held_;
};
}
#endif
