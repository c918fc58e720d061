// SPDX-License-Identifier: BSD-3-Clause
#include "granular/data_file/section_rows.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace granular
{
/// Returns true if the line up to a byte has begun a comment.
bool Uncommented::is_comment(std::int64_t offset) const
{
  std::string before;
  for (std::int64_t bytes = 256; offset > begin_; bytes *= 2)
  {
    const std::int64_t from = std::max(begin_, offset - bytes);
    before.resize(static_cast<std::size_t>(offset - from));
    before.resize(source_.read(from, before.data(), before.size()));
    const std::size_t feed = before.rfind('\n');
    if (feed != before.npos || from == begin_)
    {
      return before.find('#', feed == before.npos ? 0 : feed) != before.npos;
    }
  }
  return false;
}

std::size_t Uncommented::read(std::int64_t offset, char* buffer, std::size_t bytes) const
{
  const bool begins_inside = this->is_comment(offset);
  const std::size_t got = source_.read(offset, buffer, bytes);
  char* const end = buffer + got;
  for (char* at = begins_inside ? buffer : std::find(buffer, end, '#'); at != end;
       at = std::find(at, end, '#'))
  {
    while (at != end && *at != '\n')
    {
      *at++ = ' ';
    }
  }
  return got;
}

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
