// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_geometry_box_h
#define granular_geometry_box_h

#include "granular/geometry/compensated.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>

namespace granular
{
using Vector3 = std::array<double, 3>;
using Twofold3 = std::array<Twofold, 3>;

inline Vector3 values_of(const Twofold3& vector) noexcept
{
  return { vector[0].value(), vector[1].value(), vector[2].value() };
}

inline double dot(const Vector3& a, const Vector3& b) noexcept
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Vector3 cross(const Vector3& a, const Vector3& b) noexcept
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

inline double length_of(const Vector3& a) noexcept
{
  const double square = dot(a, a);
  return square > 0x1p-900 ? std::sqrt(square) : std::hypot(a[0], a[1], a[2]);
}

/// The smallest axis-aligned box around a box, and the tilts: the numbers in the headers of dumps.
struct BoxBounds
{
  Vector3 lo = {};
  Vector3 hi = {};
  double xy = 0;
  double xz = 0;
  double yz = 0;
};

/// The simulation box: a corner and three edge vectors, in any unit of length. Edge vectors are differences of the
/// file's numbers and need more bits than a double has: far from the origin, or where sums cancel, a rounded length
/// would show in the coordinates.
struct Box
{
  Twofold3 origin = {};
  std::array<Twofold3, 3> vectors = {}; ///< a, b, c
  std::string boundary; ///< flags as written, "pp pp ff"; empty if the file has none
  bool tilted = false;  ///< any of xy, xz, yz or a general cell: not axis-aligned
  bool general = false; ///< a and b need not lie in x and the xy plane

  /// Returns the axis-aligned box with these bounds.
  static Box from_bounds(const Vector3& lo, const Vector3& hi);

  /// Returns the tilted box with this bounding box and the tilts xy, xz, yz. Files hold the bounds, the box is xlo =
  /// xlo_bound - min(0, xy, xz, xy + xz), xhi = xhi_bound - max(0, xy, xz, xy + xz), and likewise y with yz
  /// (documentation of LAMMPS, "Triclinic simulation boxes").
  static Box from_tilted_bounds(
    const Vector3& lo, const Vector3& hi, double xy, double xz, double yz);

  /// Returns the box with this corner and these edges (LAMMPS' general triclinic boxes).
  static Box from_vectors(const Vector3& origin, const std::array<Vector3, 3>& vectors);

  /// Returns the box with this corner and these edges, as simple as they are: general only if a is not along x or b not in the
  /// xy plane.
  static Box from_edges(const Vector3& origin, const std::array<Vector3, 3>& edges);

  /// Returns the bounds of a box that is not general triclinic, each rounded once: the numbers that the box was made
  /// from come back unchanged.
  BoxBounds bounds() const;

  /// Returns the corner (i, j, k), each 0 or 1, minus the point `less`, correctly rounded.
  Vector3 corner(int i, int j, int k, const Vector3& less = {}) const;
};

/// Returns the boundary flags as dumps print them, "pp pp ff", from that form or from one letter per axis, "p p f": p
/// is periodic, f fixed, s and m shrinking. Throws FormatError.
std::string parse_boundary(const std::string& text);

/// Checks that a box can be written. Throws Error if an upper bound is below its lower bound or is not a number.
void check_bounds(const Box& box);

/// Checks that a box can scale coordinates. Throws Error if it has no volume.
void check_volume(const Box& box);

/// Returns true if two numbers give a range, lo to hi: neither lo > hi nor 0 0, which forms show where nothing was given.
inline bool is_given(const double* range) noexcept
{
  return range[0] <= range[1] && (range[0] != 0 || range[1] != 0);
}

/// A region: xlo xhi ylo yhi zlo zhi, closed; an axis without a range that is given is not restricted.
using Region = std::span<const double, 6>;

/// Returns true if the region restricts an axis.
inline bool restricts(Region region) noexcept
{
  return is_given(&region[0]) || is_given(&region[2]) || is_given(&region[4]);
}

/// Returns true if a point is inside. A coordinate that is no number is in no region that restricts its axis.
inline bool contains(Region region, const double* point) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double* const range = &region[2 * axis];
    if (is_given(range) && !(point[axis] >= range[0] && point[axis] <= range[1]))
    {
      return false;
    }
  }
  return true;
}
}
#endif
