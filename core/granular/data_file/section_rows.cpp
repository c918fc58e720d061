// SPDX-License-Identifier: BSD-3-Clause
#include "granular/data_file/section_rows.h"

#include <memory>
#include <utility>

namespace granular
{
SectionRows::SectionRows(const FramePiece& file, const ByteSource& source,
  const DataSection& section, const std::vector<std::string>& columns)
  : file_(file.file)
  , source_(source)
  , uncommented_(source, section.offset)
  , has_comments_(section.has_comments)
  , entry_(file.entry)
{
  FrameKind kind;
  kind.schema = ColumnSchema(columns);
  kind.layout = FrameKind::bare;
  entry_.kind = std::make_shared<const FrameKind>(std::move(kind));
  entry_.rows = section.rows;
  entry_.offset = section.offset;
  entry_.line = section.line;
  entry_.end = section.end;
}

std::vector<FramePiece> SectionRows::pieces() const
{
  const ByteSource& uncommented = uncommented_;
  return { { file_, entry_, has_comments_ ? &uncommented : &source_ } };
}
}
