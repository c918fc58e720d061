// SPDX-License-Identifier: BSD-3-Clause
#include "granular/decomposition/decomposition_file.h"

#include "granular/decomposition/decomposition_grid.h"
#include "granular/decomposition/voxels.h"

#include <array>
#include <utility>

namespace granular
{
namespace
{
void add_boxes(const DecompositionGrid& grid, std::vector<Subdomain>& subdomains)
{
  const auto& [x, y, z] = grid.coordinates;
  for (std::size_t k = 0; k + 1 < z.size(); ++k)
  {
    for (std::size_t j = 0; j + 1 < y.size(); ++j)
    {
      for (std::size_t i = 0; i + 1 < x.size(); ++i)
      {
        subdomains.push_back({ { x[i], y[j], z[k] }, { x[i + 1], y[j + 1], z[k + 1] } });
      }
    }
  }
}

/// The points of a cell. Throws FormatError where one is not there.
std::array<Vector3, corners_of_voxel> corners_of(
  const DecompositionGrid& grid, std::int64_t cell, LegacyVtk& file)
{
  std::array<Vector3, corners_of_voxel> corners;
  const std::int64_t* const points =
    grid.voxels.connectivity.data() + cell * std::int64_t{ corners_of_voxel };
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    if (points[i] < 0 || points[i] >= grid.number_of_points)
    {
      throw FormatError("expected points from 0 to " + std::to_string(grid.number_of_points - 1) +
          " in cell " + std::to_string(cell) + ", got " + std::to_string(points[i]),
        file.where_of(grid.voxels, cell));
    }
    const double* const point = grid.points.data() + 3 * points[i];
    corners[i] = { point[0], point[1], point[2] };
  }
  return corners;
}

void add_voxels(const DecompositionGrid& grid, std::vector<Subdomain>& subdomains, LegacyVtk& file,
  Notices& notices)
{
  std::int64_t reflected = 0;
  for (std::int64_t cell = 0; cell < grid.cells; ++cell)
  {
    Subdomain subdomain;
    const CornerOrder order = bounds_of_cell(corners_of(grid, cell, file), subdomain);
    if (order == CornerOrder::None)
    {
      throw FormatError("expected the corners of a box along the axes, in the order of a voxel or "
                        "a hexahedron, got cell " +
          std::to_string(cell) + " with others",
        file.where_of(grid.voxels, cell));
    }
    reflected += order == CornerOrder::Reflected ? 1 : 0;
    subdomains.push_back(subdomain);
  }
  if (reflected > 0)
  {
    notices.push_back(note_reflected(file.where(grid.header.place), reflected));
  }
}
}

Decomposition read_decomposition(
  const ByteSource& source, const FrameEntry& entry, Notices& notices, Progress& progress)
{
  LegacyVtk file(source, { entry.offset, entry.line }, entry.end, progress);
  const DecompositionGrid grid = read_grid(file, true);
  if (grid.cells != entry.rows)
  {
    throw IoError("the file changed since it was indexed: expected " + std::to_string(entry.rows) +
        " cells, got " + std::to_string(grid.cells) + "; reload the files",
      file.where(grid.header.place));
  }
  Decomposition decomposition;
  std::vector<Subdomain>& subdomains = decomposition.subdomains;
  subdomains.reserve(static_cast<std::size_t>(grid.cells));
  if (grid.rectilinear)
  {
    add_boxes(grid, subdomains);
  }
  else
  {
    add_voxels(grid, subdomains, file, notices);
  }
  decomposition.has_particles = grid.has_particles;
  decomposition.has_ranks = grid.has_ranks;
  for (std::size_t i = 0; i < subdomains.size(); ++i)
  {
    subdomains[i].particles = grid.has_particles ? grid.particles[i] : 0;
    subdomains[i].rank =
      static_cast<int>(grid.has_ranks ? grid.ranks[i] : static_cast<std::int64_t>(i));
  }
  return decomposition;
}

Notice note_reflected(const Where& where, std::int64_t cells)
{
  return { where,
    "corners of " + std::to_string(cells) + (cells == 1 ? " voxel are" : " voxels are") +
      " in the order of LIGGGHTS-INL, x and z exchanged: they were put right" };
}
}
