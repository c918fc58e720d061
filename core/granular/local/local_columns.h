// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_local_columns_h
#define granular_local_local_columns_h

#include "granular/base/column.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// THE table of what columns of local data mean: the ends of a line, what it is, and what acts along it. Arrays are named as
/// in the files of LIGGGHTS' own `dump local/gran/vtk`.
std::span<const KnownColumn> local_known_columns() noexcept;

/// The name in the table of a column that says what it holds, as programs and their users spell it: batom1x is x1, bforceX
/// is forcex. Other names, such as c_b[1], stay as they are.
std::string_view local_name(std::string_view name) noexcept;

/// The columns of the computes of contacts (pair/gran/local, wall/gran/local) that a keyword stands for, such as pos or
/// force; empty: it is none.
std::vector<std::string> columns_of_keyword(std::string_view keyword);

/// Columns and arrays of local data with these names of the table, or any others. Coordinates of the ends become the arrays
/// `position1` and `position2`.
ColumnSchema make_local_schema(const std::vector<std::string>& names);

/// Whether the names say where lines are, and between which particles.
bool has_ends(const ColumnSchema& schema);
bool has_ids(const ColumnSchema& schema);
}
#endif
