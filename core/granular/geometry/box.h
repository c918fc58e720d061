// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_geometry_box_h
#define granular_geometry_box_h

#include "granular/geometry/compensated.h"

#include <array>
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

/// The smallest box along the axes around a box, and its tilts: what the headers of dumps hold.
struct BoxBounds
{
  Vector3 lo = {};
  Vector3 hi = {};
  double xy = 0;
  double xz = 0;
  double yz = 0;
};

/// The simulation box: a corner and three edge vectors, any units of length.
/// Edge vectors are differences of the file's numbers and so need more bits than a double has:
/// far from the origin, or where sums cancel, a rounded length would show in the coordinates.
struct Box
{
  Twofold3 origin = {};
  std::array<Twofold3, 3> vectors = {}; ///< a, b, c
  std::string boundary; ///< flags as written, "pp pp ff"; empty if the file has none
  bool tilted = false;  ///< any of xy, xz, yz or a general cell: not axis-aligned
  bool general = false; ///< a and b need not lie in x and the xy plane

  /// From the bounds of an axis-aligned box.
  static Box from_bounds(const Vector3& lo, const Vector3& hi);

  /// From the bounding box of a tilted box and its tilts xy, xz, yz. The files hold the bounds,
  /// the box is: xlo = xlo_bound - min(0, xy, xz, xy + xz), xhi = xhi_bound - max(0, xy, xz,
  /// xy + xz), likewise y with yz (documentation of LAMMPS, "Triclinic simulation boxes").
  static Box from_tilted_bounds(
    const Vector3& lo, const Vector3& hi, double xy, double xz, double yz);

  /// From a corner and three edges (LAMMPS' general triclinic boxes).
  static Box from_vectors(const Vector3& origin, const std::array<Vector3, 3>& vectors);

  /// Of a box that is not general, each number rounded once: those that it was made from come back as they
  /// were.
  BoxBounds bounds() const;

  /// The corner (i, j, k), each 0 or 1, less a point, correctly rounded.
  Vector3 corner(int i, int j, int k, const Vector3& less = {}) const;
};

/// The boundary flags as dumps print them, "pp pp ff", from that or from one letter an axis, "p p f": p is
/// periodic, f fixed, s and m shrinking. Throws FormatError.
std::string parse_boundary(const std::string& text);

/// Makes sure that a box can be written: throws Error where an upper bound is below its lower one, or is no number.
void check_bounds(const Box& box);

/// Makes sure that a box can scale coordinates: throws Error where it has no volume.
void check_volume(const Box& box);
}
#endif
