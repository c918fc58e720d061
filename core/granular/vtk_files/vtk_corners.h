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
/// Points of a voxel or a hexahedron.
inline constexpr int corners_of_voxel = 8;

/// Where a value of a list stands, for messages.
using WhereOf = std::function<Where(std::int64_t)>;

/// The cells that the line of the file begins; keep: with their points. Throws FormatError where one has other than
/// eight.
VtkCells read_eight_point_cells(LegacyVtk& file, bool keep);

/// Throws FormatError: a cell has another number of points.
[[noreturn]] void fail_points_of_cell(std::int64_t points, const Where& where);

/// Throws UnsupportedError where a cell is neither a voxel nor a hexahedron.
void check_types(const std::vector<std::int64_t>& types, const WhereOf& where_of);

/// The points of a cell of eight, in its order; points: x y z of each. Throws FormatError where one is not there.
std::array<Vector3, corners_of_voxel> corners_of(std::span<const double> points,
  const VtkCells& cells, std::int64_t cell, const WhereOf& where_of);
}
#endif
