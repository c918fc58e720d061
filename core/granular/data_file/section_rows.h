// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_data_file_section_rows_h
#define granular_data_file_section_rows_h

#include "granular/data_file/data_layout.h"
#include "granular/data_file/uncommented.h"
#include "granular/frames/run_index.h"

#include <string>
#include <vector>

namespace granular
{
/// Presents the rows of a section of a data file as the rows of a frame without a header, for read_dump. The file and
/// the source must outlive this object.
class SectionRows
{
public:
  SectionRows(const FramePiece& file, const ByteSource& source, const DataSection& section,
    const std::vector<std::string>& columns);

  /// Returns one piece, which points into this object.
  std::vector<FramePiece> pieces() const;

private:
  const FileIndex& file_;
  const ByteSource& source_;
  Uncommented uncommented_;
  bool has_comments_;
  FrameEntry entry_;
};
}
#endif
