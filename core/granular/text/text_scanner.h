// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_text_text_scanner_h
#define granular_text_text_scanner_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/common/words.h"
#include "granular/text/line_scan.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The beginning of a section's line.
inline constexpr std::string_view item_mark = "ITEM:";

/// The settings for skipping rows on several threads, if the source allows it. The result is the same for all values.
struct ScanAhead
{
  int threads = 1;
  std::int64_t after = std::int64_t{ 1 } << 21; ///< bytes that one thread passes over first
  std::size_t chunk = std::size_t{ 1 } << 18;   ///< bytes that a thread takes at a time
};

/// Reads a text line by line, skips rows at scan speed, and keeps count of lines and bytes.
class TextScanner
{
public:
  /// The longest header line; a longer one is a LimitError. No dump has such a line, but a file of zeros does.
  static constexpr std::size_t longest_line = std::size_t{ 1 } << 22;

  /// Starts at byte `offset`, which is the start of line number `line`. window is the number of bytes that are read at
  /// a time; lines may be longer.
  TextScanner(const ByteSource& source, std::int64_t offset, std::int64_t line,
    std::size_t window = std::size_t{ 1 } << 18, const ScanAhead& ahead = {});

  /// Gives the next line without its LF or CRLF. Returns false at the end of the text. A last line without LF does not
  /// count: the program that writes it may not have finished. Valid until the next call.
  bool next(std::string_view& line);

  /// Makes next() give the last line again.
  void put_back() noexcept;

  /// Moves to another place, the start of line number `line`.
  void go_to(std::int64_t offset, std::int64_t line) noexcept;

  /// Skips lines up to one that begins with "ITEM:", or to the end of the text. Returns the number of skipped lines
  /// with words; a line without LF does not count.
  std::int64_t skip_to_item(Progress& progress);

  /// Returns this many bytes before the next line, from the window or read again into the buffer. Valid until the next
  /// call.
  std::string_view before(std::size_t bytes, std::string& buffer) const;

  std::int64_t offset() const noexcept { return window_offset_ + static_cast<std::int64_t>(at_); }
  std::int64_t line() const noexcept { return line_; } ///< number of the line that comes next

  /// Returns the place of the last line that next() gave.
  Where where() const { return { source_.path(), last_line_, -1, {} }; }
  std::int64_t last_offset() const noexcept { return last_offset_; }
  std::int64_t last_line() const noexcept { return last_line_; }

private:
  /// The lines that skip_to_item has passed.
  struct Passed
  {
    std::int64_t rows = 0;
    std::int64_t line_start = 0; ///< of the line at hand
    std::int64_t reported = 0;   ///< offset
    LineState state = {};
  };
  struct Chunk;

  bool fill();
  bool skip_window(Passed& passed, bool at_end);
  bool skip_chunks(Passed& passed, Progress& progress);
  void report(std::int64_t offset, Passed& passed, Progress& progress) const;
  Chunk scan_chunk(std::int64_t from, const LineState* state, PaddedBuffer& buffer) const;
  bool join(const Chunk& chunk, Passed& passed);

  const ByteSource& source_;
  ScanAhead ahead_;
  std::vector<PaddedBuffer> buffers_; ///< of the threads
  PaddedBuffer window_;
  std::size_t at_ = 0;  ///< next byte in window_
  std::size_t end_ = 0; ///< bytes in window_
  std::int64_t window_offset_ = 0;
  std::int64_t line_ = 1;
  std::int64_t last_offset_ = 0;
  std::int64_t last_line_ = 0;
};
}
#endif
