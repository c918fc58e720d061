// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_decomposition_decomposition_grid_h
#define granular_formats_decomposition_decomposition_grid_h

#include "granular/formats/decomposition/voxels.h"
#include "granular/formats/vtk_files/vtk_grid.h"
#include "granular/grid/subdomains.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace granular
{
/// The largest number of ranks that a file may claim: more than any machine has. Without the limit, a few coordinates
/// could claim any number of them.
inline constexpr std::int64_t most_processes = std::int64_t{ 1 } << 24;

/// A dataset of a decomposition file, as it stands in the file.
struct DecompositionGrid : VtkGrid
{
  bool has_data = false; ///< of points or cells
  bool has_particles = false;
  bool has_ranks = false;
  std::vector<std::int64_t> particles;
  std::vector<std::int64_t> ranks;

  bool rectilinear() const noexcept { return header.dataset == vtk_rectilinear; }

  /// Returns true if DIMENSIONS announce more cells than the dataset has, as in the per-rank files of PFM.
  bool is_piece() const noexcept;
};

/// A cell array that describes ranks.
struct ProcessArray
{
  std::string_view name;
  bool DecompositionGrid::*there;
  std::vector<std::int64_t> DecompositionGrid::*numbers;
  std::int64_t most;
  bool only_if_none; ///< another name that is less usual

  /// Throws FormatError if a value is not from 0 to most. There is one value per cell.
  void check(const std::vector<std::int64_t>& values, const WhereOf& where_of) const;
};

/// Returns the arrays nlocal, proc and procID.
std::span<const ProcessArray> process_arrays() noexcept;

/// Returns the bounds of a cell of an unstructured grid; see bounds_of_cell. Throws FormatError if a point is missing.
CornerOrder bounds_of(
  const DecompositionGrid& grid, std::int64_t cell, const WhereOf& where_of, Subdomain& subdomain);

/// Reads a dataset, from its header to the next one or to the end. keep: store the numbers. Throws Error; see
/// LegacyVtk::ended.
DecompositionGrid read_grid(LegacyVtk& file, bool keep);
}
#endif
