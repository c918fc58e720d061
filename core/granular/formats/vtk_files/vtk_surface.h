// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_vtk_files_vtk_surface_h
#define granular_formats_vtk_files_vtk_surface_h

#include "granular/formats/vtk_files/vtk_grid.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace granular
{
/// An array of points or of cells: whole numbers or others, as its type says.
struct SurfaceArray
{
  VtkArray what;
  bool of_cells = false;
  std::vector<double> numbers;
  std::vector<std::int64_t> integers;
};

/// POLYDATA of a legacy file: particles, walls, contacts.
struct VtkSurface : VtkGrid
{
  std::vector<SurfaceArray> arrays;
  bool has_others = false; ///< arrays of words or bytes, which are passed over

  /// Returns true if there is a point array of this name.
  bool has(std::string_view name) const noexcept;

  /// Returns the number of cells of all parts.
  std::int64_t part_cells() const noexcept;
};

/// The numbers of a surface that are read; others are passed over.
enum class SurfaceRead : std::uint8_t
{
  None,
  Points, ///< and their arrays
  All
};

/// Reads a surface. Throws as VtkGridReader, and FormatError for arrays of other sizes.
VtkSurface read_surface(LegacyVtk& file, SurfaceRead what);
}
#endif
