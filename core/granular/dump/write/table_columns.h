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
/// The columns of rows that are no particles, but contacts, bonds or anything else. Nothing is made up for them, and no name
/// stands for another one: a column is an array of that name, or A[3] the third component of A, if the array does not say what
/// its components are called.

/// The columns that are written where nobody says which: those of the file that the rows come from, as far as there are
/// arrays, with a notice of those that are left out, and then the arrays that are new.
std::vector<std::string> default_table_columns(const FrameView& frame, Notices& notices);

/// A list of columns with the names of arrays of several components replaced by those of these: A by A[1] .. A[n], or as
/// the array has it.
std::vector<std::string> expand_table_columns(
  const std::vector<std::string>& names, const FrameView& frame);

/// Finds the array, or the component of one, of each column. The ids of the ends, id1 and id2, are written with all their
/// digits, whatever their type. Throws Error where there is none, but in a frame without rows and arrays.
ColumnPlan plan_table_columns(const std::vector<std::string>& names, const FrameView& frame);
}
#endif
