// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_dump_write_table_columns_h
#define granular_dump_write_table_columns_h

#include "granular/common/error.h"
#include "granular/dump/write/column_plan.h"
#include "granular/particles/frame_view.h"

#include <string>
#include <vector>

namespace granular
{
/// The columns of rows that are not particles, but contacts, bonds or others. No column is made up, and no name stands for
/// another: a column is an array of that name, or A[3] the third component of A, unless the array names its components.

/// Returns the default columns: those of the file that the rows come from, if there are arrays, with a notice about the
/// others, and then new arrays.
std::vector<std::string> default_table_columns(const FrameView& frame, Notices& notices);

/// Replaces the names of arrays with several components by those of the components: A by A[1] .. A[n], or by the array's own
/// names.
std::vector<std::string> expand_table_columns(
  const std::vector<std::string>& names, const FrameView& frame);

/// Finds the array, or the component of an array, for each column. The ids of the ends, id1 and id2, are written with all
/// digits, for any type. Throws Error if there is none, except in a frame without rows and arrays.
ColumnPlan plan_table_columns(const std::vector<std::string>& names, const FrameView& frame);
}
#endif
