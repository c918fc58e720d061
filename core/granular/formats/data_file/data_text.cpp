// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/data_file/data_text.h"

#include <algorithm>

namespace granular
{
std::size_t DataText::read(std::int64_t offset, char* buffer, std::size_t bytes) const
{
  const bool begins_inside = blanks_comments_ && this->is_comment(offset);
  std::size_t got = source_.read(offset, buffer, bytes);
  char* const end = buffer + got;
  if (got < bytes && this->lacks_feed(offset, buffer, got))
  {
    buffer[got++] = '\n';
  }
  for (char* at = begins_inside ? buffer
         : blanks_comments_     ? std::find(buffer, end, '#')
                                : end;
       at != end; at = std::find(at, end, '#'))
  {
    while (at != end && *at != '\n')
    {
      *at++ = ' ';
    }
  }
  return got;
}

/// Returns true if the content ends behind these bytes, without a line feed.
bool DataText::lacks_feed(std::int64_t offset, const char* buffer, std::size_t got) const
{
  char last = '\n';
  if (got > 0)
  {
    last = buffer[got - 1];
  }
  else if (offset > 0)
  {
    source_.read(offset - 1, &last, 1);
  }
  return last != '\n' && source_.unchecked().empty();
}

/// Returns true if the line up to a byte has begun a comment.
bool DataText::is_comment(std::int64_t offset) const
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
}
