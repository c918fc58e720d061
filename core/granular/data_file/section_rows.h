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
/// The rows of a section of a data file as those of a frame, for read_dump: rows without a header. File and source must
/// outlive it.
class SectionRows
{
public:
  SectionRows(const FramePiece& file, const ByteSource& source, const DataSection& section,
    const std::vector<std::string>& columns);

  /// One piece, which points into this.
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
