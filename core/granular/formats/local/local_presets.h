// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_local_local_presets_h
#define granular_formats_local_local_presets_h

#include "granular/common/error.h"
#include "granular/geometry/box.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The columns of a file without names: those of a compute, in its order.
struct LocalPreset
{
  std::string_view name;
  std::string_view columns; ///< names of local_known_columns(), blank-separated
};

/// All presets; their order does not change.
std::span<const LocalPreset> local_presets() noexcept;

/// Some rows of a file, which distinguish presets.
struct LocalSample
{
  std::size_t rows = 0;
  std::vector<double> values = {}; ///< rows x columns
  Box box = {};
  bool has_box = true; ///< false: it is unknown which positions are images of each other
};

/// Returns true if rows fit a preset. Ids are integers from 1, different at both ends. Bond types are integers other than 0.
/// The periodic flag is 1 if the ends are more than half the box apart, otherwise 0. An id is always at the same position, or
/// an image of it. Not all forces are points between the ends. Without positions, bond types have few values (their number
/// squared is at most the number of rows). columns: columns of the file that the preset names, in its order, of `all` in a
/// row.
bool fits(const LocalPreset& preset, std::span<const std::size_t> columns, std::size_t all,
  const LocalSample& sample);

/// Returns true if the values of force are such: of contacts, of which nearly all push. Torques of them do not.
bool are_forces(const LocalPreset& preset, std::span<const std::size_t> columns, std::size_t all,
  const LocalSample& sample);

/// Throws FormatError if rows contradict the names that a map with the keyword history gives to columns: it stands for as many
/// columns as are left, so others are taken for the last ones of the compute where the file lacks these. Ids, types and flags are as
/// above, areas not negative, and some contact points between the ends.
void check_history(const std::vector<std::string>& columns, const std::vector<std::string>& names,
  const LocalSample& sample);

/// Returns the columns of a file under names of local_known_columns() where these give the meaning; others keep their own.
std::vector<std::string> name_columns(const std::vector<std::string>& columns);

/// Returns the columns by a preset, for all columns, or for those with meaningless names if their number fits; or those of the
/// preset for a frame without rows that names no columns. Throws FormatError if neither number fits.
std::vector<std::string> name_columns(
  const std::vector<std::string>& columns, const LocalPreset& preset);

/// Returns the columns by the user's words: a name for each column in order, or keywords of the computes of contacts (pos id
/// force), or both (see expand_keywords); or pairs NAME=COLUMN, where COLUMN is a name or a number from 1, and other columns
/// keep their names. Names and columns are separated by blanks or commas. A frame without rows that names no columns has those of
/// the map. Throws FormatError for a repeated name, a column that is named twice or missing, and a wrong number of names.
std::vector<std::string> name_columns(
  const std::vector<std::string>& columns, const std::string& map);

/// Returns true if the names of a map give the positions of lines or their particles.
bool maps_lines(const std::string& map);

/// Returns true if the names of columns give the positions of lines or their particles: no values are needed then.
bool say_what_they_are(const std::vector<std::string>& columns);

/// Finds the meaning of columns: by their names if these give the positions of lines or their particles; otherwise by the
/// only preset that fits the sample, with a notice if others have as many columns, unless the forces are seen to push. If none fits, the
/// names count, with a notice that says how to get lines; so they do without rows. Throws FormatError that lists the presets if
/// several fit, or some fit but for a few rows, which are damaged: they fit every second row.
std::vector<std::string> find_columns(const std::vector<std::string>& columns,
  const LocalSample& sample, const Where& where, Notices& notices);
}
#endif
