// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_text_line_scan_h
#define granular_text_line_scan_h

#include "granular/text/row_text.h"

#include <cstdint>
#include <string_view>

namespace granular
{
/// The state of the line that a scan is in.
struct LineState
{
  bool start = true; ///< no byte of it was passed
  bool blank = true; ///< no word of it was passed
};

/// The lines that scan_lines passed over.
struct LineScan
{
  const char* ptr;                       ///< the line that begins with the mark, or last
  std::int64_t feeds = 0;                ///< line feeds before ptr
  std::int64_t blank_lines = 0;          ///< how many of these lines have no words
  const char* after_last_feed = nullptr; ///< behind the last of them; null if there is none
  LineState state = {};                  ///< at ptr
};

/// Counts the line feeds of [first, last) up to the first line whose first byte is `mark`. state is the state of the
/// line at `first`. The text must be in a PaddedBuffer.
LineScan scan_lines(const char* first, const char* last, char mark, LineState state,
  Simd simd = best_simd()) noexcept;

/// Counts line feeds up to the first line that begins with a word, which may continue after `last`, up to `end`.
LineScan scan_to_word(const char* first, const char* last, const char* end, std::string_view word,
  LineState state) noexcept;
}
#endif
