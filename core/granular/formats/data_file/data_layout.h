// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_data_file_data_layout_h
#define granular_formats_data_file_data_layout_h

#include "granular/bytes/byte_source.h"
#include "granular/common/error.h"
#include "granular/common/progress.h"
#include "granular/frames/file_format.h"
#include "granular/geometry/box.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace granular
{
/// The rows of a section of a data file.
struct DataSection
{
  std::string comment;        ///< behind the name of the section, as in "Atoms # sphere"
  std::int64_t name_line = 0; ///< number of the line that names the section
  std::int64_t offset = 0;    ///< of the line behind the name
  std::int64_t line = 0;      ///< number of that line
  std::int64_t end = 0;       ///< byte behind the last row
  std::int64_t rows = 0;
  std::string first_row;        ///< without its comment
  std::size_t fewest_words = 0; ///< of a row of Ellipsoids: exponents may stand in some
  bool has_comments = false;    ///< some lines before the end have a #
};

/// The positions of the parts of a data file of LAMMPS or LIGGGHTS (documentation of LAMMPS, read_data).
struct DataLayout : FileLayout
{
  std::int64_t timestep = 0; ///< write_data puts it into the title; 0 without
  std::string units;         ///< likewise; may be empty
  std::int64_t atoms = 0;
  std::int64_t bonds = 0;
  std::int64_t ellipsoids = 0;
  Box box; ///< -0.5 to 0.5 along axes that the header lacks; boundaries are not in the file
  std::optional<DataSection> particles; ///< section Atoms
  std::optional<DataSection> velocities;
  std::optional<DataSection> bond_rows;      ///< section Bonds
  std::optional<DataSection> ellipsoid_rows; ///< section Ellipsoids
};

/// Returns true if the first bytes of a file are a title and a header that counts atoms.
bool starts_data_file(std::string_view first_bytes);

/// Reads the header and skips all sections, counting the rows of those in the layout. A section Atoms, Bonds or
/// Ellipsoids without rows may be missing. Throws FormatError if rows are missing or too many; IoError; Cancelled.
DataLayout read_data_layout(const ByteSource& source, Progress& progress);
}
#endif
