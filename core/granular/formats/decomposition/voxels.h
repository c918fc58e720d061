// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_formats_decomposition_voxels_h
#define granular_formats_decomposition_voxels_h

#include "granular/common/progress.h"
#include "granular/formats/vtk_files/vtk_grid.h"
#include "granular/grid/subdomains.h"
#include "granular/memory/block.h"
#include "granular/parallel/executor.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>

namespace granular
{
/// The corner (i, j, k), each 0 (low) or 1 (high) along x, y, z, is number 4i + 2j + k of a subdomain, as dump
/// decomposition/vtk numbers points.
///
/// A VTK_VOXEL names its corners with x fastest: its corner i + 2j + 4k is point 4i + 2j + k. With the points in
/// the order of their numbers the cell would be a mirror image: of volume 0, and never found.
inline constexpr std::array<std::int64_t, corners_of_voxel> voxel_corners = { 0, 4, 2, 6, 1, 5, 3,
  7 };

/// Subdomains as voxels.
struct Voxels
{
  Block points; ///< number_of_points x 3 doubles
  std::int64_t number_of_points = 0;
  Block connectivity; ///< of each subdomain 8 std::int64_t, in the order of VTK_VOXEL
};

/// Makes voxels. Point 8p + 4i + 2j + k is the corner (i, j, k) of subdomain p minus the origin, rounded once.
/// The result does not depend on threads. Throws std::bad_alloc; Cancelled.
Voxels make_voxels(std::span<const Subdomain> subdomains, const Vector3& origin,
  const Executor& executor, Progress& progress, const std::shared_ptr<BlockPool>& pool = nullptr);

/// The order of the points of a cell.
enum class CornerOrder : std::uint8_t
{
  Voxel,      ///< i + 2j + 4k
  Reflected,  ///< 4i + 2j + k, as LIGGGHTS-INL writes voxels: x and z exchanged
  Hexahedron, ///< VTK_HEXAHEDRON
  None        ///< another, or no box along the axes
};

/// Finds the order by which corners share coordinates (a nan equals a nan), and sets the bounds: those of the first corner
/// are lo, even above hi. points: of the corners in the order of the cell. Flat cells and points (equal bounds) count as
/// Voxel where possible. None leaves the bounds unchanged.
CornerOrder bounds_of_cell(
  std::span<const Vector3, corners_of_voxel> points, Subdomain& subdomain) noexcept;
}
#endif
