// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_grid_cell_finder_h
#define granular_grid_cell_finder_h

#include "granular/grid/euler_grid.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace granular
{
/// Finds the cells of a grid that hold points: lo <= x < hi, in the last along an axis x <= hi. Comparisons with the rounded
/// faces decide.
class CellFinder
{
public:
  explicit CellFinder(const EulerGrid& grid) noexcept;

  /// Returns the number along an axis, or -1 if none holds it.
  std::int64_t find(std::size_t axis, double x) const noexcept
  {
    const Axis& a = axes_[axis];
    const double place = (x - a.lo) * a.per_length;
    if (place > 0 && place < a.count)
    {
      const auto cell = static_cast<std::int32_t>(place);
      if (std::abs(place - cell - 0.5) < 0.5 - a.rounding)
      {
        return cell; // rounding cannot matter
      }
    }
    return this->find_by_faces(axis, x);
  }

  /// Returns true if a sphere is entirely, and clearly, inside a cell of a range, with the number of this cell there.
  bool find_whole(const double* centre, double radius, const CellRange& within,
    std::int64_t& cell) const noexcept;

  /// Stores the numbers within a range, x fastest, of the cells of points x y z; -1 for others. Returns true if all are
  /// others.
  bool find(
    std::span<const double> points, const CellRange& within, std::int64_t* cells) const noexcept;

private:
  struct Axis
  {
    double lo;
    double hi;
    double spacing;    ///< see EulerGrid::face
    double per_length; ///< cells
    double
      rounding; ///< so near to a face, in cells, faces have to be looked at; 1/2 and more: always
    double count;
  };

  std::int64_t find_by_faces(std::size_t axis, double x) const noexcept;

  std::array<Axis, 3> axes_;
};
}
#endif
