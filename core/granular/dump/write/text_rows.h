// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_text_rows_h
#define granular_dump_write_text_rows_h

#include "granular/dump/write/column_plan.h"
#include "granular/dump/write/row_buffer.h"
#include "granular/dump/write/row_values.h"

namespace granular
{
/// Adds rows as lines of text, with a blank between columns, and one at the end of each line if trailing_blank. Throws
/// FormatError for a text that is not one word.
void print_rows(
  const RowValues& values, const ColumnPlan& plan, bool trailing_blank, RowBuffer& to);
}
#endif
