// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/decomposition/decomposition_file.h"

#include "granular/formats/decomposition/decomposition_grid.h"
#include "granular/formats/decomposition/voxels.h"
#include "granular/formats/decomposition/vtu_grids.h"

#include <algorithm>

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

/// Adds cells of an unstructured grid. Returns how many were put right.
std::int64_t add_voxels(
  const DecompositionGrid& grid, std::vector<Subdomain>& subdomains, const WhereOf& where_of)
{
  std::int64_t reflected = 0;
  for (std::int64_t cell = 0; cell < grid.cells; ++cell)
  {
    Subdomain subdomain;
    const CornerOrder order = bounds_of(grid, cell, where_of, subdomain);
    if (order == CornerOrder::None)
    {
      throw FormatError("expected the corners of a box along the axes, in the order of a voxel or "
                        "a hexahedron, got cell " +
          std::to_string(cell) + " with others",
        where_of(cell));
    }
    reflected += order == CornerOrder::Reflected ? 1 : 0;
    subdomains.push_back(subdomain);
  }
  return reflected;
}

/// The subdomains of a grid. Adds to reflected how many cells were put right.
Decomposition subdomains_of(
  const DecompositionGrid& grid, const WhereOf& where_of, std::int64_t& reflected)
{
  Decomposition decomposition = { {}, grid.has_particles, grid.has_ranks };
  std::vector<Subdomain>& subdomains = decomposition.subdomains;
  subdomains.reserve(static_cast<std::size_t>(grid.cells));
  if (grid.rectilinear())
  {
    add_boxes(grid, subdomains);
  }
  else
  {
    reflected += add_voxels(grid, subdomains, where_of);
  }
  for (std::size_t i = 0; i < subdomains.size(); ++i)
  {
    subdomains[i].particles = grid.has_particles ? grid.particles[i] : 0;
    subdomains[i].rank = static_cast<int>(grid.has_ranks ? grid.ranks[i] : static_cast<int>(i));
  }
  return decomposition;
}

Decomposition read_legacy(
  const ByteSource& source, const FrameEntry& entry, std::int64_t& reflected, Progress& progress)
{
  LegacyVtk file(source, { entry.offset, entry.line }, entry.end, progress);
  const DecompositionGrid grid = read_grid(file, true);
  check_cells(entry, grid.cells, file.where(grid.header.place));
  return subdomains_of(
    grid, [&](std::int64_t cell) { return file.where_of(grid.voxels, cell); }, reflected);
}

/// The pieces one after the other.
Decomposition read_vtu(
  const ByteSource& source, const FrameEntry& entry, std::int64_t& reflected, Progress& progress)
{
  const std::string text = read_up_to(source, entry.end);
  const VtuGrids grids(text, source.path());
  grids.check();
  check_cells(entry, grids.cells(), { source.path(), entry.line });
  if (grids.size() == 0)
  {
    return { {}, false, false };
  }
  std::vector<Decomposition> pieces; // what not all of them have is not known
  for (std::size_t i = 0; i < grids.size(); ++i)
  {
    progress.step(static_cast<double>(i) / static_cast<double>(grids.size()));
    pieces.push_back(subdomains_of(
      grids.read(i), [&](std::int64_t cell) { return grids.where_of(i, cell); }, reflected));
  }
  return join(pieces);
}
}

Decomposition read_decomposition(
  const ByteSource& source, const FrameEntry& entry, Notices& notices, Progress& progress)
{
  const bool xml = entry.offset == 0 &&
    is_vtu(read_up_to(source, std::min(entry.end, std::int64_t{ vtu_head_bytes })));
  const Where where = { source.path(), entry.line, entry.line > 0 ? -1 : entry.offset };
  std::int64_t reflected = 0;
  Decomposition decomposition = (xml ? read_vtu : read_legacy)(source, entry, reflected, progress);
  if (reflected > 0)
  {
    notices.push_back(note_reflected(where, reflected));
  }
  return decomposition;
}

Decomposition read_decomposition_pieces(
  const std::vector<FramePiece>& pieces, Notices& notices, Progress& progress)
{
  std::vector<Decomposition> parts;
  for (const FramePiece& piece : pieces)
  {
    parts.push_back(read_decomposition(*open_indexed(piece.file), piece.entry, notices, progress));
  }
  Decomposition all = join(parts);
  all.has_ranks = all.has_ranks ||
    (parts.size() > 1 && !parts.front().has_ranks && parts.front().subdomains.size() == 1 &&
      all.subdomains.size() == pieces.size());
  return all;
}

Notice note_reflected(const Where& where, std::int64_t cells)
{
  return { where,
    "corners of " + std::to_string(cells) + (cells == 1 ? " voxel are" : " voxels are") +
      " in the order of LIGGGHTS-INL, x and z exchanged: they were put right" };
}
}
