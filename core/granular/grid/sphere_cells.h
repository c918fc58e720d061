// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_grid_sphere_cells_h
#define granular_grid_sphere_cells_h

#include "granular/geometry/box.h"
#include "granular/grid/cell_finder.h"
#include "granular/grid/euler_grid.h"

#include <array>
#include <cstdint>
#include <vector>

namespace granular
{
/// The volume of a sphere in a cell of a grid.
struct CellShare
{
  std::int64_t cell = 0; ///< number in the requested range, x fastest
  double volume = 0;     ///< above 0
};

/// Divides spheres among the cells of a grid, each volume as exact as in centred_box_volume.
class SphereCells
{
public:
  /// short_cuts: false computes each cell in the bounds of a sphere by centred_box_volume, for comparison.
  explicit SphereCells(const EulerGrid& grid, bool short_cuts = true);

  /// Returns the cells in the bounds of a sphere; none if the sphere itself touches no cell. radius^2 is a normal number.
  CellRange range(const Twofold3& centre, double radius) const noexcept;

  /// Adds the shares of a sphere at hi + lo of the centre, finite, radius >= 0, in cells within a range of the grid. A sphere
  /// without volume has no shares. May be called from any thread.
  void find(const Twofold3& centre, double radius, const CellRange& within,
    std::vector<CellShare>& shares) const;

private:
  struct Cut;

  bool touches(const Twofold3& centre, double radius) const noexcept;
  std::int64_t cell_of(std::size_t axis, double x) const noexcept;
  bool add_quickly(const Twofold3& centre, double radius, const CellRange& within,
    std::vector<CellShare>& shares) const;
  bool cut_once(
    std::size_t axis, std::int64_t cell, Twofold centre, double radius, Cut& cut) const noexcept;
  void add_cells(const Twofold3& centre, double radius, const CellRange& within,
    std::vector<CellShare>& shares) const;

  EulerGrid grid_;
  std::array<std::vector<double>, 3> faces_;
  CellFinder finder_;
  bool short_cuts_;
};
}
#endif
