// SPDX-License-Identifier: BSD-3-Clause
// Files for tests that are not part of the project.
#ifndef granular_tests_restart_shared_file_h
#define granular_tests_restart_shared_file_h

#include <cstdlib>
#include <filesystem>
#include <string>

/// A file in the folder that the environment variable GRANULAR_SHARED names, or else in a folder shared/data beside the source tree or
/// above it; empty where there is none: not everybody has it.
inline std::string shared_file(const std::string& name)
{
  if (const char* const shared = std::getenv("GRANULAR_SHARED"))
  {
    const std::filesystem::path path = std::filesystem::path(shared) / name;
    return std::filesystem::exists(path) ? path.string() : "";
  }
  for (std::filesystem::path folder = GRANULAR_DATA; folder != folder.root_path();
       folder = folder.parent_path())
  {
    const std::filesystem::path path = folder / "shared" / "data" / name;
    if (std::filesystem::exists(path))
    {
      return path.string();
    }
  }
  return "";
}
#endif
