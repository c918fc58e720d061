// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_lines_line_columns_h
#define granular_lines_line_columns_h

#include "granular/columns/column.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The table of local data columns: the ends of a line, its identity, and the quantities along it. Arrays have the names in
/// the files of LIGGGHTS' own `dump local/gran/vtk`.
std::span<const KnownColumn> local_known_columns() noexcept;

/// Returns the table's name of a column in a spelling of programs and users: batom1x is x1, bforceX is forcex. Other names,
/// such as c_b[1], are unchanged.
std::string_view local_name(std::string_view name) noexcept;

/// Returns names of columns from words that are such names or keywords of the computes of contacts (pair/gran/local,
/// wall/gran/local): pos vel id force force_normal force_tangential torque torque_normal torque_tangential history
/// contactArea delta contactPoint ms_id heatFlux; wall_id is the id of wall/gran/local. Each keyword stands for its columns,
/// history for as many as are left. If all words are keywords they are taken in this order, which is that of the file in any
/// order of the compute; among other names they must be in it. As many words as columns, of which some are no keywords, name one
/// column each. Throws FormatError.
std::vector<std::string> expand_keywords(std::vector<std::string> words, std::size_t columns);

/// Returns columns and arrays of local data with these names of the table, or any others. Coordinates of the ends become the
/// arrays `position1` and `position2`.
ColumnSchema make_local_schema(const std::vector<std::string>& names);

/// Returns the table's names for the columns of an array with so many components: forcex forcey forcez; none if it is
/// unknown.
std::vector<std::string> local_component_names(std::string_view array, int components);

/// Returns true if the names give the positions of lines and their particles.
bool has_ends(const ColumnSchema& schema);
bool has_ids(const ColumnSchema& schema);
}
#endif
