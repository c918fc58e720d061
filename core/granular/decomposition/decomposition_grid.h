// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_decomposition_decomposition_grid_h
#define granular_decomposition_decomposition_grid_h

#include "granular/decomposition/subdomains.h"
#include "granular/decomposition/voxels.h"
#include "granular/vtk_files/legacy_vtk.h"
#include "granular/vtk_files/vtk_corners.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace granular
{
/// More processes than any machine has: a few coordinates may claim as many as they like.
inline constexpr std::int64_t most_processes = std::int64_t{ 1 } << 24;

/// A dataset of a decomposition file as it stands there. What is in vectors is there only if it was to be kept.
struct DecompositionGrid
{
  VtkHeader header;
  bool rectilinear = false;
  std::int64_t cells = 0;
  bool has_data = false; ///< of points or cells
  bool has_particles = false;
  bool has_ranks = false;
  std::vector<std::int64_t> particles;
  std::vector<std::int64_t> ranks;

  std::array<std::int64_t, 3> dimensions = {};         ///< as DIMENSIONS says
  std::array<std::int64_t, 3> counts = {};             ///< of coordinates
  std::array<std::vector<double>, 3> coordinates = {}; ///< in any order

  std::vector<double> points;
  VtkCells voxels; ///< of eight points each, all of them there

  /// Whether DIMENSIONS say more cells than there are, as in the files of single processes that PFM writes.
  bool is_piece() const noexcept;
};

/// An array of cells that tells what is known of a process.
struct ProcessArray
{
  std::string_view name;
  bool DecompositionGrid::*there;
  std::vector<std::int64_t> DecompositionGrid::*numbers;
  std::int64_t most;
  bool only_if_none; ///< another name that is less usual

  /// One value a cell: throws FormatError where one is not from 0 to most.
  void check(const std::vector<std::int64_t>& values, const WhereOf& where_of) const;
};

/// nlocal, proc, procID.
std::span<const ProcessArray> process_arrays() noexcept;

/// The bounds of a cell of an unstructured grid; see bounds_of_cell. Throws FormatError where one of its points is not
/// there.
CornerOrder bounds_of(
  const DecompositionGrid& grid, std::int64_t cell, const WhereOf& where_of, Subdomain& subdomain);

/// Reads a dataset, from its header to the next one or the end; keep: with its numbers. Throws Error; see
/// LegacyVtk::ended.
DecompositionGrid read_grid(LegacyVtk& file, bool keep);
}
#endif
