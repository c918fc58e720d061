// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_frames_other_files_h
#define granular_frames_other_files_h

#include "granular/bytes/byte_source.h"

#include <optional>
#include <string>

namespace granular
{
/// A file that no kind of run reads, told by its first bytes.
struct OtherFile
{
  std::string text; ///< its name, and what to do with it: "a web page: ..."
  bool is_vtk;      ///< some of these are read by kinds of their own
  bool is_taken;    ///< a reader of ParaView takes it under its usual name
};

/// Returns the file that contents are, or none if they may be those of a run. may_be_rows: texts are none, as somebody has named their
/// columns.
std::optional<OtherFile> find_other(const ByteSource& source, bool may_be_rows = false);

/// Throws UnsupportedError, which says what the contents are, for files of find_other; of VTK unless a format reads some.
void refuse_other(
  const ByteSource& source, const char* expected, bool reads_vtk = false, bool may_be_rows = false);

/// Returns true for empty files and files of find_other, but for those that ParaView opens itself: a reader that takes such a
/// file says by its error what the file is, where ParaView lists all its readers. Never throws.
bool is_refused_file(const std::string& path) noexcept;
}
#endif
