// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_averages_line_cells_h
#define granular_averages_line_cells_h

#include "granular/averages/particle_cells.h"
#include "granular/averages/smooth_cells.h"
#include "granular/geometry/box.h"
#include "granular/grid/cell_finder.h"
#include "granular/grid/euler_grid.h"
#include "granular/grid/periodic_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace granular
{
/// Divides lines among the cells of a grid: by their length in each cell, or by a kernel (see SmoothCells). Lines have the
/// periodic images that particles have.
class LineCells
{
public:
  LineCells(const EulerGrid& grid, const WeightOptions& options, const Box* box);
  LineCells(const LineCells&) = delete;
  LineCells& operator=(const LineCells&) = delete;

  /// Working memory of a thread.
  struct Room
  {
    std::vector<double> cuts;
    SmoothCells::Room of_kernel;
  };

  /// Checks that lines up to that length can be divided; throws LimitError. Returns the largest number of shares that one may
  /// have in one cell.
  std::int64_t check(double length) const;

  /// Calls visit(range) with the cells that each image of a line may belong to.
  template <class Visit>
  void each_range(const Vector3& start, const Vector3& branch, const Visit& visit) const
  {
    this->each_image(start, branch,
      [&](const Vector3& image, const Vector3& middle)
      {
        const CellRange range =
          smooth_ ? smooth_->range(image, branch, middle) : this->range(image, branch);
        if (range.size() > 0)
        {
          visit(range);
        }
      });
  }

  /// Calls add(cell in the range, share) for the cells of a range that a line belongs to: shares are in (0, 1], and those of
  /// all cells of a line inside the grid have the sum 1.
  template <class Add>
  void each_share(const Vector3& start, const Vector3& branch, const CellRange& within, Room& room,
    const Add& add) const
  {
    this->each_image(start, branch,
      [&](const Vector3& image, const Vector3& middle)
      {
        if (!smooth_)
        {
          this->cut(image, branch, within, room, add);
        }
        else if (!smooth_->each(image, branch, middle, within, room.of_kernel, add))
        {
          // along an axis with one cell the middle decides, as with a wider kernel
          Vector3 from = image;
          Vector3 along = branch;
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            from[axis] = grid_.counts[axis] == 1 ? middle[axis] : from[axis];
            along[axis] = grid_.counts[axis] == 1 ? 0 : along[axis];
          }
          this->cut(from, along, within, room, add);
        }
      });
  }

private:
  /// Calls visit(start of the image, its middle): both on the side of faces on which the exact image of the middle is.
  template <class Visit>
  void each_image(const Vector3& start, const Vector3& branch, const Visit& visit) const
  {
    Vector3 middle;
    Vector3 reach;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      middle[axis] = start[axis] + branch[axis] / 2;
      reach[axis] = std::abs(branch[axis]) / 2;
    }
    images_.each(middle.data(), smooth_ ? smooth_->reach(branch) : reach,
      [&](const Twofold3& image)
      {
        Vector3 moved;
        const Vector3 at = floors_of(image);
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          const auto& [hi, lo] = image[axis];
          const double to_start = start[axis] - middle[axis];
          moved[axis] = at[axis] == middle[axis] ? start[axis]
            : to_start == 0                      ? at[axis]
                                                 : hi + (lo + to_start);
        }
        visit(moved, at);
      });
  }

  CellRange range(const Vector3& start, const Vector3& branch) const noexcept;
  void find_cuts(const Vector3& start, const Vector3& branch, std::vector<double>& cuts) const;

  /// By length: the line is cut at all faces that it crosses, at multiples of 2^-53 of it, so that the parts have the sum 1.
  template <class Add>
  void cut(const Vector3& start, const Vector3& branch, const CellRange& within, Room& room,
    const Add& add) const
  {
    this->find_cuts(start, branch, room.cuts);
    const bool point = branch == Vector3{};
    for (std::size_t i = 0; i + 1 < room.cuts.size(); ++i)
    {
      const double part = room.cuts[i + 1] - room.cuts[i];
      const double middle = room.cuts[i] + part / 2;
      std::array<std::int64_t, 3> cell;
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const double x = start[axis] + middle * branch[axis];
        cell[axis] = images_.is_twice(axis, x) ? -1 : finder_.find(axis, x);
      }
      const std::int64_t number = within.number(cell);
      if (number >= 0 && part > 0)
      {
        add(number, part);
      }
      if (point)
      {
        break;
      }
    }
  }

  EulerGrid grid_;
  CellFinder finder_;
  PeriodicImages images_;
  std::optional<SmoothCells> smooth_;
};
}
#endif
