// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_neighbours_h
#define granular_packing_neighbours_h

#include "granular/packing/box_shape.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace granular
{
/// The grains in a part of the box, by cells: tells whether there is room for another one. Grains of
/// different sizes are on levels, each with radii up to twice those of the next and cells of that size.
class Neighbours
{
public:
  /// Forgets all grains. low and high bound the part, in scaled coordinates; radii are to be from smallest
  /// to largest, grains about as many as are going to be added, and gap is kept between any two.
  void start(const BoxShape& box, const Vector3& low, const Vector3& high, double smallest,
    double largest, double gap, double grains);

  bool holds(const Vector3& scaled) const noexcept;

  /// A grain whose centre the part holds.
  void add(const Vector3& scaled, double radius);

  /// Whether a grain, whose centre the part holds, would be clear of all others.
  bool has_room(const Vector3& scaled, double radius) const noexcept;

private:
  struct Level
  {
    double radius = 0;               ///< the largest
    std::array<int, 3> cells = {};   ///< along each axis
    Vector3 scale = {};              ///< cells per scaled coordinate
    std::vector<std::int32_t> first; ///< grain of each cell, or none
  };

  struct Grain
  {
    Vector3 centre; ///< from the low corner
    double radius;
    std::int32_t next; ///< in the same cell, or none
  };

  static constexpr std::int32_t none = -1;

  void lay(Level& level, double grains) const;
  std::size_t cell_of(const Level& level, const Vector3& scaled) const noexcept;
  Vector3 from_low(const Vector3& scaled) const noexcept;
  bool is_clear(std::int32_t first, const Vector3& centre, double radius) const noexcept;

  const BoxShape* box_ = nullptr;
  Vector3 low_ = {};
  Vector3 high_ = {};
  double gap_ = 0;
  std::size_t levels_used_ = 0;
  std::vector<Level> levels_;
  std::vector<Grain> grains_;
};
}
#endif
