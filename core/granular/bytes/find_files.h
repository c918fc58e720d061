// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_bytes_find_files_h
#define granular_bytes_find_files_h

#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// Returns the files of a run by patterns as in the dump command, absolute and in the order of the numbers in their names:
/// name_2 before name_10. `*` stands for the timestep and `%` for the rank; `?` and `[...]` as in a shell.
///
/// If some files have a number for each `*` of the last part of the path, only these are found; otherwise all that fit. So
/// run_*.dump does not find run_first.dump beside run_100.dump. Plain and compressed files go together: run_*.dump also finds
/// run_100.dump.gz and run_100.dump.zst. Files with `boundingBox` in their names, which LIGGGHTS writes beside some dumps,
/// are left out. The name of a file that there is stands for this file alone, and so do the names of folders that there are.
/// Throws IoError if a pattern fits no file, or names something else than a file, or a folder that cannot be listed.
std::vector<std::string> find_files(const std::vector<std::string>& patterns);

/// Returns a path with slashes alone: Windows also takes backslashes.
std::string with_slashes(const std::string& path);

/// Returns true if there is something at a path, perhaps behind links. Throws IoError if the system does not tell.
bool is_there(const std::string& path);

/// Returns true if a name has a number, with or without decimals, for each `*` of a pattern.
bool has_numbers(std::string_view name, std::string_view pattern);
}
#endif
