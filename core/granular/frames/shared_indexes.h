// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_shared_indexes_h
#define granular_frames_shared_indexes_h

#include "granular/frames/file_index.h"

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace granular
{
/// The indexes of files that the runs of a process have at present, so that another run of a file need not look through it.
/// An index goes with the last run that has it. Several threads may share this.
///
/// Only what was seen in a file is shared, not what an index file says; and only of files that had rested when they were looked at:
/// see had_rested. A compressed file is not shared by a run that had no room for its seek points. Other files are looked through by
/// each run.
class SharedIndexes
{
public:
  using Files = std::vector<FileIndex>;

  /// Adds the files of a run, as they were before FileFormat::complete.
  void add(const std::shared_ptr<const Files>& files);

  /// Returns a copy of the newest index of a file; update_file_index compares it with the file. Returns nothing if no run has
  /// one.
  std::optional<FileIndex> find(const std::string& path, const FileFormat* format) const;

  /// Returns true if find would return an index.
  bool has(const std::string& path, const FileFormat* format) const;

private:
  struct Place
  {
    std::weak_ptr<const Files> files;
    std::size_t number = 0;
  };

  /// Calls visit(index) for the newest index of a file, if there is one.
  template <class Visit>
  void visit_newest(const std::string& path, const FileFormat* format, const Visit& visit) const;

  mutable std::mutex mutex_;
  std::multimap<std::pair<std::string, const FileFormat*>, Place> places_; ///< equal ones by age
};
}
#endif
