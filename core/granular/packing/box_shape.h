// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_box_shape_h
#define granular_packing_box_shape_h

#include "granular/geometry/box.h"

#include <array>
#include <cstdint>
#include <initializer_list>

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
}
#endif
