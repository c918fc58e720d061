// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_lattice_h
#define granular_packing_lattice_h

#include "granular/packing/box_shape.h"

#include <array>
#include <cstdint>
#include <span>

namespace granular
{
/// A cubic cell of a lattice: its length in units of the distance of nearest neighbours, and its particles in units of
/// the cell.
struct LatticeCell
{
  const char* name;
  double length;
  std::span<const Vector3> particles;
  double last; ///< coordinate of a particle along any axis
};

enum class LatticeKind : std::uint8_t
{
  SimpleCubic,
  FaceCentredCubic
};

/// Whole cells of a lattice along the vectors of a box, in its middle, sheared with the box. Neighbours are
/// nowhere nearer than the distance asked for, also after their coordinates are rounded: across a periodic axis
/// cells are stretched, and in a sheared box all are, as much as needed. Only in a box that holds its cells exactly,
/// neighbours may be nearer by the rounding of coordinates: see nearest. Across other axes particles lie wholly inside.
class Lattice
{
public:
  /// Throws LimitError if no cell fits.
  Lattice(LatticeKind kind, const BoxShape& box, double distance, double radius);

  /// Returns the number of particles: the cells times the particles of each.
  std::int64_t capacity() const noexcept;

  /// Returns the position of a particle in the box of the constructor, x fastest, then y, then z.
  Vector3 point(std::int64_t row, const BoxShape& box) const noexcept;

  /// Returns a distance that no two particles and images are nearer than, in exact arithmetic.
  double nearest() const noexcept { return nearest_; }

  /// Calls visit for every particle of the full lattice that is nearer to another one than a distance, and for some that
  /// are not.
  void visit_near(
    std::int64_t row, const BoxShape& box, double distance, const VisitNear& visit) const;

  /// Returns the lengths of a box for a number of particles, as much like a cube as whole cells allow.
  static Vector3 lengths_for(LatticeKind kind, const std::array<bool, 3>& periodic, double distance,
    double radius, std::int64_t particles);

private:
  CellCounts cells_for(const BoxShape& box, double length, double radius) const noexcept;
  CellCounts place_of(std::int64_t row) const noexcept;
  const Vector3& part_of(std::int64_t row) const noexcept;
  void lay_axis(const BoxShape& box, std::size_t axis, double length);
  void lay(const BoxShape& box, double length, double radius);
  double lay(const BoxShape& box, double length, double radius, double clear);
  void spread(const BoxShape& box, double length, double radius);
  void settle(const BoxShape& box, double distance, double clear);
  bool is_exact(const BoxShape& box, std::size_t axis, double distance) const noexcept;
  double nearest(const BoxShape& box, double enough) const noexcept;

  const LatticeCell& cell_;
  CellCounts cells_ = {};
  Vector3 first_ = {}; ///< scaled coordinate of a particle at 0 of the first cell
  Vector3 step_ = {};  ///< from cell to cell
  double nearest_;
  std::array<bool, 3>
    exact_ = {}; ///< axes along which coordinates are whole steps of nearest_ from the first one
};
}
#endif
