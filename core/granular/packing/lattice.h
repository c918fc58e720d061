// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_lattice_h
#define granular_packing_lattice_h

#include "granular/geometry/box.h"

#include <array>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>

namespace granular
{
/// A box in plain doubles, and derived values. Scaled coordinates are in units of the box vectors.
struct BoxShape
{
  /// The box has a boundary of checked_boundary. Throws LimitError if it is not a valid box.
  explicit BoxShape(const Box& box);

  Vector3 origin;
  std::array<Vector3, 3> vectors;
  std::array<bool, 3> periodic;
  std::array<Vector3, 3>
    faces;         ///< products with a position from the origin are its scaled coordinates
  Vector3 heights; ///< distance of the two faces that a vector leads between
  double volume = 0;
  double reach = 0; ///< the largest magnitude of a coordinate of a corner
  bool aligned;     ///< with the axes, and corner and lengths are doubles

  /// Returns how much nearer than in exact arithmetic two points may be because of rounding.
  double rounding() const noexcept;

  /// Returns true if the box is aligned, and coordinates that are sums of these numbers are exact in it.
  bool adds(std::initializer_list<double> numbers) const noexcept;

  /// Returns a position in space, always rounded in the same way.
  Vector3 point(const Vector3& scaled) const noexcept;

  /// Returns the position from the origin of the box.
  Vector3 edge(const Vector3& scaled) const noexcept
  {
    Vector3 sum;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sum[axis] =
        scaled[0] * vectors[0][axis] + scaled[1] * vectors[1][axis] + scaled[2] * vectors[2][axis];
    }
    return sum;
  }

  /// Returns the scaled coordinates of a position from the origin.
  Vector3 scaled(const Vector3& edge) const noexcept
  {
    return { dot(edge, faces[0]), dot(edge, faces[1]), dot(edge, faces[2]) };
  }
};

/// Returns "pp ff fs" from that or from "p f fs": three words of one or two of the letters p (periodic), f, s and m; p is
/// never combined with another. Throws LimitError.
std::string checked_boundary(const std::string& boundary);

/// A particle of a packing; its id is its row + 1.
struct PlacedParticle
{
  Vector3 point;
  double radius;
  std::int32_t type;
};

/// Number of each box vector that a periodic image is away.
using PeriodicImage = std::array<std::int8_t, 3>;

/// Numbers of cells along each box vector, or the place of a cell.
using CellCounts = std::array<std::int64_t, 3>;

/// Calls visit(cell, image) for the cells from low to high, x fastest. Beyond the cells from 0 to counts - 1 are their images,
/// and along axes that are not periodic nothing.
template <class Visit>
void for_cells(const CellCounts& low, const CellCounts& high, const CellCounts& counts,
  const std::array<bool, 3>& periodic, const Visit& visit)
{
  CellCounts cell;
  PeriodicImage image;
  const auto go_to = [&](std::size_t axis, std::int64_t at)
  {
    const std::int64_t count = counts[axis];
    const std::int64_t away = at < 0 ? (at + 1) / count - 1 : at < count ? 0 : at / count;
    image[axis] = static_cast<std::int8_t>(away);
    cell[axis] = at - away * count;
    return away == 0 || periodic[axis];
  };
  for (std::int64_t z = low[2]; z <= high[2]; ++z)
  {
    for (std::int64_t y = low[1]; go_to(2, z) && y <= high[1]; ++y)
    {
      for (std::int64_t x = low[0]; go_to(1, y) && x <= high[0]; ++x)
      {
        if (go_to(0, x))
        {
          visit(cell, image);
        }
      }
    }
  }
}

/// Returns a position moved by the box vectors of an image, or back by them with the sign -1.
inline Vector3 moved(
  const Vector3& at, const PeriodicImage& image, const BoxShape& box, double sign = 1) noexcept
{
  if (image == PeriodicImage{})
  {
    return at;
  }
  const Vector3 edge = box.edge({ sign * image[0], sign * image[1], sign * image[2] });
  return { at[0] + edge[0], at[1] + edge[1], at[2] + edge[2] };
}

/// Receives particles near another one, once per image.
using VisitNear = std::function<void(std::int64_t row, const PeriodicImage& image)>;

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
