// SPDX-License-Identifier: BSD-3-Clause
#include "granular/vtk_files/vtk_corners.h"

#include <algorithm>
#include <string>

namespace granular
{
namespace
{
constexpr std::int64_t points_a_cell = corners_of_voxel;
}

VtkCells read_eight_point_cells(LegacyVtk& file, bool keep)
{
  const std::int64_t first = file.count(1);
  const std::int64_t second = file.count(2);
  const bool counted = second % 9 == 0 && second / 9 == first;
  const bool with_offsets = second % 8 == 0 && second / 8 == std::max(first, std::int64_t{ 1 }) - 1;
  if (!counted && !with_offsets)
  {
    file.fail(
      "eight points in each cell", "CELLS " + std::to_string(first) + " " + std::to_string(second));
  }
  VtkCells cells = file.cells(keep);
  const std::vector<std::int64_t>& offsets = cells.offsets;
  for (std::size_t i = 1; i < offsets.size(); ++i)
  {
    if (offsets[i] - offsets[i - 1] != points_a_cell)
    {
      fail_points_of_cell(
        offsets[i] - offsets[i - 1], file.where_of(cells, static_cast<std::int64_t>(i) - 1));
    }
  }
  return cells;
}

void fail_points_of_cell(std::int64_t points, const Where& where)
{
  throw FormatError("expected eight points in a cell, got " + std::to_string(points), where);
}

void check_types(const std::vector<std::int64_t>& types, const WhereOf& where_of)
{
  constexpr std::int64_t voxel = 11;
  constexpr std::int64_t hexahedron = 12;
  const auto other = std::find_if(types.begin(), types.end(),
    [](std::int64_t type) { return type != voxel && type != hexahedron; });
  if (other != types.end())
  {
    throw UnsupportedError(
      "expected the cell type of a voxel (11) or a hexahedron (12), got " + std::to_string(*other),
      where_of(other - types.begin()));
  }
}

std::array<Vector3, corners_of_voxel> corners_of(
  std::span<const double> points, const VtkCells& cells, std::int64_t cell, const WhereOf& where_of)
{
  const auto number_of_points = static_cast<std::int64_t>(points.size() / 3);
  const std::int64_t* const numbers = cells.connectivity.data() + cell * points_a_cell;
  std::array<Vector3, corners_of_voxel> corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    if (numbers[i] < 0 || numbers[i] >= number_of_points)
    {
      throw FormatError("expected points from 0 to " + std::to_string(number_of_points - 1) +
          " in cell " + std::to_string(cell) + ", got " + std::to_string(numbers[i]),
        where_of(cell));
    }
    const double* const point = points.data() + 3 * numbers[i];
    corners[i] = { point[0], point[1], point[2] };
  }
  return corners;
}
}
