// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_local_presets_h
#define granular_local_local_presets_h

#include "granular/common/error.h"
#include "granular/geometry/box.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// What the columns of a file are that does not name them: those of a compute, in its order.
struct LocalPreset
{
  std::string_view name;
  std::string_view columns; ///< names of local_known_columns(), blank-separated
};

/// All presets; their order does not change.
std::span<const LocalPreset> local_presets() noexcept;

/// Some rows of a file, by which presets are told apart.
struct LocalSample
{
  std::size_t rows = 0;
  std::vector<double> values = {}; ///< rows x columns
  Box box = {};
  bool has_box = true; ///< false: it is not known which places are images of each other
};

/// Whether rows can be what a preset says: ids are integers from 1 on, and those of the two ends differ; bond types are
/// integers other than 0; the periodic flag is 1 where the ends are more than half the box apart, else 0; an id is
/// always at the same place, or an image of it; forces are not all points between the ends; and, where there
/// are no places, bond types have few values (their number squared is at most that of the rows). columns are the columns of the file that the preset names, in its order; of
/// `all` in a row.
bool fits(const LocalPreset& preset, std::span<const std::size_t> columns, std::size_t all,
  const LocalSample& sample);

/// The columns of a file under names of local_known_columns(), where these are what they say; others keep their own.
std::vector<std::string> name_columns(const std::vector<std::string>& columns);

/// The same as a preset has it, for all columns, or for those whose names say nothing if these are as many. Throws FormatError
/// if neither are.
std::vector<std::string> name_columns(
  const std::vector<std::string>& columns, const LocalPreset& preset);

/// The same as the user has it: either a name for each column in turn, or keywords of the computes of contacts (pos id force),
/// or both (see expand_keywords), or pairs NAME=COLUMN, where COLUMN is its name or its number from 1 on, and the
/// other columns keep their names. Names and columns are separated by blanks or commas. Throws FormatError for a name
/// that is given twice, a column that is named twice or not there, and another number of names than columns.
std::vector<std::string> name_columns(
  const std::vector<std::string>& columns, const std::string& map);

/// Whether the names of columns say where lines are or between which particles: no values are needed to find it out.
bool say_what_they_are(const std::vector<std::string>& columns);

/// The same, found out: by their names if these say where lines are or between which particles; else by the one
/// preset that fits the sample, with a notice that says why, if others have as many columns. Without rows columns are as
/// they are named. Throws FormatError that lists the presets if none fits or several do.
std::vector<std::string> find_columns(const std::vector<std::string>& columns,
  const LocalSample& sample, const Where& where, Notices& notices);
}
#endif
