// SPDX-License-Identifier: BSD-3-Clause
#include "granular/text/text_scanner.h"

#include "granular/parallel/executor.h"

#include <algorithm>
#include <atomic>
#include <cstring>

namespace granular
{
namespace
{
/// Largest part of a mark that may lie behind a part of the text in which it begins.
constexpr std::size_t rest_of_mark = item_mark.size() - 1;
}

/// Findings in a part of the text. Its first line may have begun before it.
struct TextScanner::Chunk
{
  std::int64_t feeds = 0;
  std::int64_t blank_lines = 0; ///< the first among them if what is here of it has no words
  std::int64_t line_start = -1; ///< of the line at its end or at the item; -1: no line begins here
  std::int64_t item = -1;       ///< offset of the first line that begins with the mark
  LineState state = {};         ///< at the end
  bool blank_head = false;      ///< the first line ends here, and what is here of it has no words
  bool last = false;            ///< the text ends here
};

TextScanner::TextScanner(const ByteSource& source, std::int64_t offset, std::int64_t line,
  std::size_t window, const ScanAhead& ahead)
  : source_(source)
  , ahead_(ahead)
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
  const std::int64_t start = this->offset();
  Passed passed;
  passed.line_start = passed.reported = start;
  bool at_end = false;
  bool done = false;
  while (!done)
  {
    const bool much = this->offset() - start >= ahead_.after && !at_end;
    if (much && ahead_.threads > 1 && source_.concurrent())
    {
      done = this->skip_chunks(passed, progress);
      continue;
    }
    done = this->skip_window(passed, at_end);
    if (!done)
    {
      at_end = !this->fill();
      this->report(this->offset(), passed, progress);
    }
  }
  return passed.rows;
}

/// Reports now and then how far the scan is.
void TextScanner::report(std::int64_t offset, Passed& passed, Progress& progress) const
{
  constexpr std::int64_t interval = std::int64_t{ 1 } << 25;
  if (offset - passed.reported >= interval)
  {
    passed.reported = offset;
    progress.step(source_.fraction(offset));
  }
}

/// Passes over what is in the window. True if that ended at an item or, at_end, at the end of the text.
bool TextScanner::skip_window(Passed& passed, bool at_end)
{
  const char* const end = window_.data() + end_;
  // where it may go on behind the window, the mark is left for the next one
  const char* const last = end - (at_end ? 0 : std::min(end_ - at_, rest_of_mark));
  const LineScan scan = scan_to_word(window_.data() + at_, last, end, item_mark, passed.state);
  passed.state = scan.state;
  passed.rows += scan.feeds - scan.blank_lines;
  line_ += scan.feeds;
  at_ = static_cast<std::size_t>(scan.ptr - window_.data());
  if (scan.after_last_feed)
  {
    passed.line_start = window_offset_ + (scan.after_last_feed - window_.data());
  }
  if (scan.ptr < last)
  {
    return true;
  }
  if (at_end)
  {
    this->go_to(passed.line_start, line_);
  }
  return at_end;
}

/// Passes over chunks that several threads look at. True if that ended at an item, or at the end.
bool TextScanner::skip_chunks(Passed& passed, Progress& progress)
{
  constexpr std::int64_t chunks_a_thread = 128; // each round costs new threads
  const auto bytes = static_cast<std::int64_t>(ahead_.chunk);
  const std::int64_t from = this->offset();
  this->report(from, passed, progress);
  const std::int64_t left = std::max(std::int64_t{ 0 }, source_.stamp().size - from);
  const auto count =
    static_cast<std::size_t>(std::min(ahead_.threads * chunks_a_thread, left / bytes + 1));
  const Executor executor(ahead_.threads);
  if (buffers_.size() < executor.workers(count))
  {
    buffers_.resize(executor.workers(count));
  }
  std::vector<Chunk> chunks(count);
  std::atomic<std::size_t> needed = count; // of them, as far as is known
  const auto scan = [&](std::size_t chunk, std::size_t worker)
  {
    if (chunk >= needed)
    {
      return;
    }
    const std::int64_t offset = from + static_cast<std::int64_t>(chunk) * bytes;
    if (worker == 0)
    {
      this->report(offset, passed, progress);
    }
    chunks[chunk] =
      this->scan_chunk(offset, chunk == 0 ? &passed.state : nullptr, buffers_[worker]);
    const bool ends = chunks[chunk].item >= 0 || chunks[chunk].last;
    for (std::size_t known = needed; ends && chunk + 1 < known;)
    {
      needed.compare_exchange_weak(known, chunk + 1);
    }
  };
  Progress ignored; // it does not know that some chunks are not needed
  executor.parallel_for(count, scan, ignored);
  this->go_to(from + static_cast<std::int64_t>(count) * bytes, line_);
  return std::ranges::any_of(chunks, [&](const Chunk& chunk) { return this->join(chunk, passed); });
}

/// state is that of the first line, null if it is not known yet.
TextScanner::Chunk TextScanner::scan_chunk(
  std::int64_t from, const LineState* state, PaddedBuffer& buffer) const
{
  const std::size_t before = state ? 0 : 1; // tells whether a line begins here
  const std::size_t wanted = before + ahead_.chunk + rest_of_mark;
  if (buffer.size() < wanted)
  {
    buffer = PaddedBuffer(wanted);
  }
  const std::size_t got =
    source_.read(from - static_cast<std::int64_t>(before), buffer.data(), wanted);
  const char* const first = buffer.data() + std::min(before, got);
  const char* const end = buffer.data() + got;
  const char* const last = std::min(first + ahead_.chunk, end);
  const bool starts = state ? state->start : got > 0 && first[-1] == '\n';
  const LineScan scan = scan_to_word(first, last, end, item_mark, { starts, true });
  Chunk chunk;
  chunk.feeds = scan.feeds;
  chunk.blank_lines = scan.blank_lines;
  chunk.state = scan.state;
  chunk.last = last == end;
  const char* const head =
    std::find_if(first, scan.ptr, [](char c) { return c == '\n' || !is_blank(c); });
  chunk.blank_head = head != scan.ptr && *head == '\n';
  if (scan.after_last_feed)
  {
    chunk.line_start = from + (scan.after_last_feed - first);
  }
  if (scan.ptr < last)
  {
    chunk.item = from + (scan.ptr - first);
    chunk.line_start = chunk.item;
  }
  return chunk;
}

/// Adds what was found in the next chunk. True if that was an item, or the end of the text.
bool TextScanner::join(const Chunk& chunk, Passed& passed)
{
  const bool no_blank_line = chunk.blank_head && !passed.state.blank;
  passed.rows += chunk.feeds - chunk.blank_lines + (no_blank_line ? 1 : 0);
  line_ += chunk.feeds;
  const bool blank_before = chunk.feeds > 0 || passed.state.blank;
  passed.state = { chunk.state.start, chunk.state.blank && blank_before };
  passed.line_start = chunk.line_start >= 0 ? chunk.line_start : passed.line_start;
  const bool done = chunk.item >= 0 || chunk.last;
  if (done)
  {
    this->go_to(passed.line_start, line_);
  }
  return done;
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
