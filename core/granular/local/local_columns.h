// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_local_columns_h
#define granular_local_local_columns_h

#include "granular/columns/column.h"

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

/// Names of columns from words that are such names or keywords of the computes of contacts (pair/gran/local,
/// wall/gran/local): pos vel id force force_normal force_tangential torque torque_normal torque_tangential history contactArea
/// delta contactPoint ms_id heatFlux; wall_id is the id of wall/gran/local. Each stands for what is printed for it, history for
/// as many columns as are left. Where all words are keywords they are taken in this order, which is that of the file, whatever
/// that of the compute; among others they must be in it. Throws FormatError.
std::vector<std::string> expand_keywords(std::vector<std::string> words, std::size_t columns);

/// Columns and arrays of local data with these names of the table, or any others. Coordinates of the ends become the arrays
/// `position1` and `position2`.
ColumnSchema make_local_schema(const std::vector<std::string>& names);

/// What the table calls the columns of an array of so many components: forcex forcey forcez; none if it does not know it.
std::vector<std::string> local_component_names(std::string_view array, int components);

/// Whether the names say where lines are, and between which particles.
bool has_ends(const ColumnSchema& schema);
bool has_ids(const ColumnSchema& schema);
}
#endif
