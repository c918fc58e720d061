// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_text_row_text_detail_h
#define granular_text_row_text_detail_h

// Parts that the decoders of the instruction sets share. Only for row_text*.cpp.

#include "granular/text/row_text.h"

namespace granular::row_text
{
struct RowPlan
{
  std::span<ColumnSink> sinks;
  std::uint32_t columns;
  RowMemory& memory;
};

void store_text(const char* first, const char* last, char* data) noexcept;

/// Continues from `result`, word by word, until it has max_rows rows, the text ends, or a word is invalid.
void decode_plain(
  const char* last, RowPlan& plan, std::int64_t max_rows, RowResult& result) noexcept;

#if GRANULAR_X86
namespace avx2
{
RowResult decode(
  const char* first, const char* last, RowPlan& plan, std::int64_t max_rows) noexcept;
}

namespace avx512
{
RowResult decode(
  const char* first, const char* last, RowPlan& plan, std::int64_t max_rows) noexcept;
}
#endif
}
#endif
