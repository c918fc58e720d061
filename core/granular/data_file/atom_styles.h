// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_data_file_atom_styles_h
#define granular_data_file_atom_styles_h

#include "granular/common/error.h"
#include "granular/data_file/data_layout.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// The columns of the sections Atoms and Velocities in an atom style, with the names in dumps. Three image counts ix iy iz
/// may follow in all rows of Atoms.
struct AtomStyle
{
  std::string_view name;
  std::string_view columns;
  std::string_view velocities = "id vx vy vz";
  bool has_bonds = false; ///< particles of the style may have bonds
};

/// The table of atom styles, from the documentation of LAMMPS (read_data) and the sources of LIGGGHTS.
std::span<const AtomStyle> atom_styles() noexcept;

/// The columns of a data file.
struct DataColumns
{
  std::vector<std::string> particles;
  std::vector<std::string> velocities; ///< the first is id; empty: the file has none
  std::vector<std::string> ellipsoids; ///< likewise: diameters, quaternions and exponents
};

/// Finds the columns: of the style that the user names; otherwise of the one in the comment `Atoms # style`; otherwise of the
/// only one that fits the first rows, with a notice. asked: empty or "automatic" leaves the choice to the file. Throws
/// FormatError that lists the styles that would fit, and for rows of Ellipsoids of other than 8 or 10 words.
DataColumns find_data_columns(
  const DataLayout& layout, std::string_view asked, const std::string& path, Notices& notices);
}
#endif
