// SPDX-License-Identifier: BSD-3-Clause
// Private to the files of this room.
#ifndef granular_bytes_no_file_h
#define granular_bytes_no_file_h

#include "granular/common/error.h"

#include <string>

namespace granular
{
/// Throws IoError for a directory, or for something else that is not a regular file.
[[noreturn]] inline void refuse_no_file(const std::string& path, bool is_folder)
{
  throw IoError(
    std::string("expected a file, got ") + (is_folder ? "a directory" : "a device or a pipe"),
    { path }, is_folder ? std::errc::is_a_directory : std::errc::not_supported);
}
}
#endif
