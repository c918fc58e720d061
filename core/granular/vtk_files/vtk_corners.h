// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_vtk_files_vtk_corners_h
#define granular_vtk_files_vtk_corners_h

#include "granular/common/error.h"
#include "granular/geometry/box.h"
#include "granular/vtk_files/legacy_vtk.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace granular
{
/// The number of points of a voxel or hexahedron.
inline constexpr int corners_of_voxel = 8;

/// Returns the place of a value of a list, for messages.
using WhereOf = std::function<Where(std::int64_t)>;

/// Reads the cells that the current line of the file begins. keep: store their points. Throws FormatError if a cell
/// does not have eight points.
VtkCells read_eight_point_cells(LegacyVtk& file, bool keep);

/// Throws FormatError: a cell has another number of points.
[[noreturn]] void fail_points_of_cell(std::int64_t points, const Where& where);

/// Throws UnsupportedError if a cell is neither a voxel nor a hexahedron.
void check_types(const std::vector<std::int64_t>& types, const WhereOf& where_of);

/// Returns the eight points of a cell in its order. points: x y z of each point. Throws FormatError if a point is
/// missing.
std::array<Vector3, corners_of_voxel> corners_of(std::span<const double> points,
  const VtkCells& cells, std::int64_t cell, const WhereOf& where_of);
}
#endif
