// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_data_file_data_layout_h
#define granular_formats_data_file_data_layout_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/frames/file_format.h"
#include "granular/geometry/box.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The values of a column in all rows.
struct ColumnValues
{
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -std::numeric_limits<double>::infinity();
  double sum = 0;
  bool whole = true;  ///< all are written as integers are: "1", and not "1.0" or "1e0"
  bool words = false; ///< some are no numbers; these do not count above
};

/// The rows of a section of a data file.
struct DataSection
{
  std::string name;
  std::string comment;        ///< behind the name of the section, as in "Atoms # sphere"
  std::int64_t name_line = 0; ///< number of the line that names the section
  std::int64_t offset = 0;    ///< of the line behind the name
  std::int64_t line = 0;      ///< number of that line
  std::int64_t end = 0;       ///< byte behind the last row
  std::int64_t rows = 0;
  std::size_t words = 0;        ///< of the first row, without its comment
  std::size_t fewest_words = 0; ///< of a row of Ellipsoids: exponents may stand in some
  std::size_t most_words = 0;   ///< likewise; 0 of other sections
  bool has_comments = false;    ///< some lines before the end have a #
  std::vector<ColumnValues>
    values; ///< of Atoms if no comment names the columns, and of what fixes write
};

/// The numbers of types by their labels.
using TypeLabels = std::map<std::string, std::int64_t, std::less<>>;

/// The positions of the parts of a data file of LAMMPS or LIGGGHTS (documentation of LAMMPS, read_data).
struct DataLayout : FileLayout
{
  std::int64_t timestep = 0; ///< write_data puts it into the title; 0 without
  std::string units;         ///< likewise; may be empty
  std::int64_t atoms = 0;    ///< this and the next ones: as the header counts them
  std::int64_t bonds = 0;
  std::int64_t ellipsoids = 0;
  std::int64_t lines = 0;
  std::int64_t triangles = 0;
  std::int64_t bodies = 0;
  std::int64_t atom_types = 0;
  std::int64_t bond_types = 0;
  Box box; ///< -0.5 to 0.5 along axes that the header lacks; boundaries are not in the file
  std::vector<DataSection> sections; ///< all, in their order
  std::map<std::string, TypeLabels, std::less<>>
    labels; ///< by section: Atom Type Labels, Bond Type Labels and so on
  std::map<std::int64_t, double> masses; ///< of types: section Masses

  /// Returns the section of this name, or null.
  const DataSection* find(std::string_view name) const noexcept;

  /// Returns the labels in the section of this name, or null.
  const TypeLabels* find_labels(std::string_view name) const noexcept;
};

/// Returns true if a name is that of a section of LAMMPS' own; others belong to fixes.
bool is_known_section(std::string_view name);

/// Returns true if the first bytes of a file are a title and a header that counts atoms.
bool starts_data_file(std::string_view first_bytes);

/// Reads the header and skips all sections, counting their rows. A section Atoms, Bonds or Ellipsoids without rows may be
/// missing. Throws FormatError if rows are missing or too many; IoError; Cancelled.
DataLayout read_data_layout(const ByteSource& source, Progress& progress);
}
#endif
