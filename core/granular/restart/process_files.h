// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_restart_process_files_h
#define granular_restart_process_files_h

#include "granular/common/progress.h"
#include "granular/restart/restart_layout.h"

#include <string>
#include <vector>

namespace granular
{
/// Names of the files of processes that belong to one with `base` in its name: `before`, the number of the process, `behind`.
struct ProcessNames
{
  std::string before; ///< with the folder
  std::string behind;

  std::string of(int process) const { return before + std::to_string(process) + behind; }

  /// Whether a path is one of these.
  bool match(const std::string& path) const;
};

/// The names that a path could stand for: one for each `base` in the name of the file, the last one first.
std::vector<ProcessNames> process_names(const std::string& base_path);

/// The one of these of which there is a file of process 0, or null.
const ProcessNames* find_process_names(const std::vector<ProcessNames>& candidates);

/// Whether there is a file, or anything else, of this name. Throws IoError where the system does not say.
bool is_there(const std::string& path);

/// What is inside of a packed source, in memory, with its path.
std::string read_content(const ByteSource& source, Progress& progress);

/// Looks at the files of all processes: layout.chunks and layout.records. Each is a count and so many doubles, records all of them.
/// Throws FormatError that names the file; IoError; Cancelled.
void read_process_files(const ProcessNames& names, RestartLayout& layout, Progress& progress);

/// Whether a source is as the file of a process is: a count, so many doubles, the first of them a length; or a count of 0 alone.
bool is_process_file(const ByteSource& source);
}
#endif
