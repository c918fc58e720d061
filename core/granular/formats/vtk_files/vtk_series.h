// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_vtk_files_vtk_series_h
#define granular_formats_vtk_files_vtk_series_h

#include "granular/frames/file_format.h"

#include <string>

namespace granular
{
/// VTK, STL and PLY files, one a timestep, which their names tell. Only the end of a file is looked at, which XML and STL need to be whole.
/// Files of one timestep whose names differ in a rank are pieces.
const FileFormat& vtk_format() noexcept;

/// Returns true for the particles of `dump custom/vtk`, `custom/vtm` (LIGGGHTS) and `dump vtk` (LAMMPS): points with an array id and no
/// cells but vertices. Legacy files must have the title of these programs, or their box beside them, which tells alone where there are no
/// points; XML files a number in the name.
bool is_vtk_particles(const std::string& path) noexcept;

/// Returns true for other legacy VTK and STL files with a number in the name and the title of these programs.
bool is_vtk_mesh(const std::string& path) noexcept;

/// Returns the file of the box that these programs wrote with a file of particles; empty if there is none.
std::string find_box_file(const std::string& path);
}
#endif
