// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_adsorption_grid_h
#define granular_packing_adsorption_grid_h

#include "granular/packing/box_shape.h"
#include "granular/packing/radii.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace granular
{
/// Cells of a box for finding random particles by position. Particles of different sizes are on levels: radii on a
/// level are up to twice those on the next one, and cells are about as large as two of its particles. Along an axis
/// that is not periodic, the cells divide the range that the faces leave for centres. Axes are ordered by the heights
/// of the box, the highest last. Cells with the same index along the last axis are a layer; a line of a layer runs
/// along the first axis. Shelves are parts of the box into which layers of all levels are sorted.
class AdsorptionGrid
{
public:
  using Cells = std::array<std::int64_t, 3>;

  /// Cells from `first` to `last` of an axis; indices beyond the cells of a periodic axis mean its images.
  struct Range
  {
    std::int64_t first;
    std::int64_t last;
  };

  AdsorptionGrid(const BoxShape& box, std::vector<SizeClass> classes);

  const BoxShape& box() const noexcept { return box_; }
  const std::vector<SizeClass>& classes() const noexcept { return classes_; }
  std::size_t levels() const noexcept { return levels_.size(); }
  std::size_t level_of(std::size_t size_class) const noexcept { return level_of_[size_class]; }

  /// Returns the largest radius on a level.
  double radius(std::size_t level) const noexcept { return levels_[level].radius; }

  /// Returns the number of cells of a level along each axis, in the order of this grid.
  const Cells& cells(std::size_t level) const noexcept { return levels_[level].cells; }

  /// Returns the axis of the box at a place in the order.
  std::size_t axis(std::size_t place) const noexcept { return order_[place]; }

  /// Returns the extra distance between touching particles, which allows for the rounding of coordinates.
  double gap() const noexcept { return gap_; }

  std::int64_t shelves() const noexcept { return shelves_; }

  /// Returns the first layer of a level in a shelf, or in the next shelf that has one.
  std::int64_t first_layer(std::size_t level, std::int64_t shelf) const noexcept
  {
    const std::int64_t layers = levels_[level].cells[2];
    return (shelf * layers + shelves_ - 1) / shelves_;
  }

  /// Calls visit(level, layer) for all layers of shelves from first to last - 1, level by level.
  template <class Visit>
  void for_layers(std::int64_t first, std::int64_t last, const Visit& visit) const
  {
    for (std::size_t level = 0; level < levels_.size(); ++level)
    {
      const std::int64_t end = this->first_layer(level, last);
      for (std::int64_t layer = this->first_layer(level, first); layer < end; ++layer)
      {
        visit(level, layer);
      }
    }
  }

  /// Returns the number of shelves before or after its own in which a particle may have others nearer than a distance.
  std::int64_t shelves_within(double distance) const noexcept;

  /// Returns the part of the last axis that contains all layers of shelves from first to last - 1, with a margin of
  /// this many layers.
  std::array<double, 2> window(std::int64_t first, std::int64_t last, double margin) const noexcept;

  /// Returns the scaled coordinate of a particle from its place between 0 and 1 in the cells along an axis of the
  /// order.
  double scaled(std::size_t size_class, std::size_t place, double part) const noexcept
  {
    const double inset = insets_[size_class][place];
    return inset + part * (1 - 2 * inset);
  }

  /// Returns the cells of a level that may have centres nearer than a distance to a scaled coordinate along an axis of
  /// the order.
  Range near(std::size_t level, std::size_t place, double scaled, double distance) const noexcept
  {
    const Level& on = levels_[level];
    const double reach = distance * per_height_[place];
    const Map& one = on.least[place];
    const Map& other = on.most[place];
    const double low = scaled - reach;
    const double high = scaled + reach;
    Range range = { whole(std::min(one.cell(low), other.cell(low))),
      whole(std::max(one.cell(high), other.cell(high))) };
    if (!box_.periodic[order_[place]])
    {
      range.first = std::max<std::int64_t>(range.first, 0);
      range.last = std::min(range.last, on.cells[place] - 1);
    }
    return range;
  }

private:
  /// Maps scaled coordinates to cells, for one inset.
  struct Map
  {
    double inset = 0;
    double scale = 0;
    double first = 0;

    double cell(double scaled) const noexcept { return first + (scaled - inset) * scale; }
  };

  struct Level
  {
    double radius = 0;
    double smallest = 0;
    std::int64_t grains = 0;
    Cells cells = {};
    std::array<Map, 3> least = {}; ///< for the smallest grains
    std::array<Map, 3> most = {};  ///< for the largest
  };

  /// Returns the largest integer that is not greater than value.
  static std::int64_t whole(double value) noexcept
  {
    const auto cut = static_cast<std::int64_t>(value);
    return cut - (value < static_cast<double>(cut) ? 1 : 0);
  }

  double inset(double radius, std::size_t place) const noexcept;
  void lay(Level& level) const;

  const BoxShape& box_;
  double gap_;
  std::array<std::size_t, 3> order_ = { 0, 1, 2 };
  Vector3 per_height_ = {};
  std::vector<SizeClass> classes_;
  std::vector<std::size_t> level_of_;
  std::vector<Vector3> insets_;
  std::vector<Level> levels_;
  std::int64_t shelves_ = 1;
  double deepest_ = 0; ///< layer, as a part of the last axis
};
}
#endif
