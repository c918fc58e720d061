// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_restart_process_files_h
#define granular_formats_restart_process_files_h

#include "granular/common/progress.h"
#include "granular/formats/restart/restart_layout.h"

#include <string>
#include <vector>

namespace granular
{
/// The names of the ranks' files that belong to a file with `base` in its name: `before`, the rank, `behind`.
struct ProcessNames
{
  std::string before; ///< with the folder
  std::string behind;

  std::string of(int process) const { return before + std::to_string(process) + behind; }

  /// Returns true if a path is one of these.
  bool match(const std::string& path) const;
};

/// Returns the possible patterns of a path: one for each `base` in the name of the file, the last one first.
std::vector<ProcessNames> process_names(const std::string& base_path);

/// Returns the pattern for which a file of rank 0 exists, or null.
const ProcessNames* find_process_names(const std::vector<ProcessNames>& candidates);

/// Looks at the files of all ranks: layout.chunks and layout.records. Each is a count and so many doubles, only records.
/// Throws FormatError that names the file; IoError; Cancelled.
void read_process_files(const ProcessNames& names, RestartLayout& layout, Progress& progress);

/// Returns true if a source is like a rank's file: a count and so many doubles, the first one a length; or only a count of 0.
bool is_process_file(const ByteSource& source);
}
#endif
