// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_grid_euler_grid_h
#define granular_grid_euler_grid_h

#include "granular/geometry/box.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace granular
{
/// A box divided into equal cells along the axes. Cells are numbered with x fastest, z slowest: (k ny + j) nx + i, as
/// in LIGGGHTS.
struct EulerGrid
{
  Vector3 lo = {};
  Vector3 hi = {};
  std::array<std::int64_t, 3> counts = {}; ///< nx ny nz

  std::int64_t size() const noexcept { return counts[0] * counts[1] * counts[2]; }

  /// Returns the edge of a cell, (hi - lo) / n, rounded in this order.
  double spacing(std::size_t axis) const noexcept;

  /// Returns where cell i of an axis begins and cell i - 1 ends, 0 <= i <= n: lo + i spacing, rounded in this order like
  /// vtkImageData, and hi for the last. Neighbours share it to the bit.
  double face(std::size_t axis, std::int64_t i) const noexcept;
  std::vector<double> faces(std::size_t axis) const; ///< all n + 1

  /// Returns lo + (i + 1/2) spacing, like LIGGGHTS.
  double centre(std::size_t axis, std::int64_t i) const noexcept;

  bool operator==(const EulerGrid&) const = default;
};

/// Cells of each axis: from first to last - 1; first == last: none.
struct CellRange
{
  std::array<std::int64_t, 3> first = {};
  std::array<std::int64_t, 3> last = {};

  /// Returns the number of cells.
  std::int64_t size() const noexcept
  {
    std::int64_t cells = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      cells *= last[axis] > first[axis] ? last[axis] - first[axis] : 0;
    }
    return cells;
  }

  /// Returns the number of a cell in the range, x fastest; -1: not there.
  std::int64_t number(const std::array<std::int64_t, 3>& cell) const noexcept
  {
    std::int64_t number = 0;
    for (std::size_t axis = 3; axis-- > 0;)
    {
      if (cell[axis] < first[axis] || cell[axis] >= last[axis])
      {
        return -1;
      }
      number = number * (last[axis] - first[axis]) + cell[axis] - first[axis];
    }
    return number;
  }

  /// Calls visit(cell) for each cell, x fastest.
  template <class Visit>
  void each(const Visit& visit) const
  {
    std::array<std::int64_t, 3> cell;
    for (cell[2] = first[2]; cell[2] < last[2]; ++cell[2])
    {
      for (cell[1] = first[1]; cell[1] < last[1]; ++cell[1])
      {
        for (cell[0] = first[0]; cell[0] < last[0]; ++cell[0])
        {
          visit(std::as_const(cell));
        }
      }
    }
  }
};

/// A user's description of the cells.
struct EulerGridRequest
{
  enum class By : std::uint8_t
  {
    Counts,
    Size,
    Cutoff
  };

  Vector3 lo = {};
  Vector3 hi = {};
  By by = By::Counts;
  std::array<std::int64_t, 3> counts = {}; ///< 1 and more along each axis
  Vector3
    size = {}; ///< edges above 0: as many cells as fit, not smaller but by rounding, at least 1
  double cutoff =
    0; ///< of all edges, as size, but cut off as in LIGGGHTS; 0, where there are no particles: one cell
};

/// The most cells of a grid, and one more than the most along an axis: VTK counts these with 32 bits.
inline constexpr std::int64_t most_cells = std::int64_t{ 1 } << 40;
inline constexpr std::int64_t most_cells_of_axis = std::int64_t{ 1 } << 31;

/// Makes the grid. Throws Error for bounds that are not finite or lo not below hi, counts below 1, sizes not above 0, and
/// cells without thickness (coinciding faces); LimitError for too many cells.
EulerGrid make_euler_grid(const EulerGridRequest& request);
}
#endif
