// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_packing_box_shape_h
#define granular_packing_box_shape_h

#include "granular/geometry/box.h"

#include <array>
#include <cstdint>
#include <functional>
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
}
#endif
