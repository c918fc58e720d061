// SPDX-License-Identifier: BSD-3-Clause
#include "granular/base/text_scanner.h"

#include "granular/base/line_scan.h"

#include <algorithm>
#include <cstring>

namespace granular
{
TextScanner::TextScanner(
  const ByteSource& source, std::int64_t offset, std::int64_t line, std::size_t window)
  : source_(source)
  , window_(window)
  , window_offset_(offset)
  , line_(line)
  , last_offset_(offset)
  , last_line_(line)
{
}

bool TextScanner::fill()
{
  std::memmove(window_.data(), window_.data() + at_, end_ - at_);
  window_offset_ += static_cast<std::int64_t>(at_);
  end_ -= at_;
  at_ = 0;
  if (end_ == window_.size())
  {
    window_.resize(2 * window_.size());
  }
  const std::size_t got = source_.read(
    window_offset_ + static_cast<std::int64_t>(end_), window_.data() + end_, window_.size() - end_);
  end_ += got;
  return got > 0;
}

bool TextScanner::next(std::string_view& line)
{
  std::size_t searched = 0; // bytes behind at_ known to hold no LF
  for (;;)
  {
    const char* const first = window_.data() + at_;
    const void* const feed = std::memchr(first + searched, '\n', end_ - at_ - searched);
    if (feed)
    {
      const char* const end = static_cast<const char*>(feed);
      last_offset_ = this->offset();
      last_line_ = line_++;
      at_ += static_cast<std::size_t>(end - first) + 1;
      line = { first, static_cast<std::size_t>(end - first) };
      if (line.ends_with('\r'))
      {
        line.remove_suffix(1);
      }
      return true;
    }
    searched = end_ - at_;
    if (searched > longest_line)
    {
      throw LimitError(
        "expected a line of at most " + std::to_string(longest_line) + " bytes, got a longer one",
        { source_.path(), line_ });
    }
    if (!this->fill())
    {
      return false;
    }
  }
}

void TextScanner::put_back() noexcept
{
  at_ = static_cast<std::size_t>(last_offset_ - window_offset_);
  line_ = last_line_;
}

std::int64_t TextScanner::skip_to_item(Progress& progress)
{
  constexpr std::int64_t report_bytes = std::int64_t{ 1 } << 25;
  std::int64_t rows = 0;
  std::int64_t line_start = this->offset(); // of the line that at_ is in
  std::int64_t reported = line_start;
  LineState state;
  for (;;)
  {
    const LineScan scan =
      scan_lines(window_.data() + at_, window_.data() + end_, item_mark.front(), state);
    state = scan.state;
    line_ += scan.feeds;
    rows += scan.feeds - scan.blank_lines;
    at_ = static_cast<std::size_t>(scan.ptr - window_.data());
    if (scan.after_last_feed)
    {
      line_start = window_offset_ + (scan.after_last_feed - window_.data());
    }
    if (at_ < end_)
    {
      while (end_ - at_ < item_mark.size() && this->fill())
      {
      }
      if (std::string_view(window_.data() + at_, end_ - at_).starts_with(item_mark))
      {
        break;
      }
      ++at_;
      state = { false, false };
    }
    if (at_ == end_ && !this->fill())
    {
      this->go_to(line_start, line_);
      break;
    }
    if (this->offset() - reported >= report_bytes)
    {
      reported = this->offset();
      progress.step(source_.fraction(reported));
    }
  }
  return rows;
}

std::string_view TextScanner::before(std::size_t bytes, std::string& buffer) const
{
  if (at_ >= bytes)
  {
    return { window_.data() + at_ - bytes, bytes };
  }
  buffer.resize(bytes);
  buffer.resize(
    source_.read(this->offset() - static_cast<std::int64_t>(bytes), buffer.data(), bytes));
  return buffer;
}

void TextScanner::go_to(std::int64_t offset, std::int64_t line) noexcept
{
  line_ = line;
  window_offset_ = offset;
  at_ = 0;
  end_ = 0;
}
}
