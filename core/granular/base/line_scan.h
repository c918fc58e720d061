// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_base_line_scan_h
#define granular_base_line_scan_h

#include "granular/base/row_text.h"

#include <cstdint>

namespace granular
{
/// What scan_lines passed over.
struct LineScan
{
  const char* ptr;              ///< the line that begins with the mark, or last
  std::int64_t feeds = 0;       ///< line feeds before ptr
  const char* after_last_feed = nullptr; ///< behind the last of them; null if there is none
};

/// Counts line feeds of [first, last) up to the first line whose first byte is mark.
/// at_line_start tells whether first is the start of a line. The text lies in a PaddedBuffer.
LineScan scan_lines(const char* first, const char* last, char mark, bool at_line_start,
  Simd simd = best_simd()) noexcept;
}
#endif
