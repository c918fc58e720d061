// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_box_vectors_h
#define granular_local_box_vectors_h

#include "granular/geometry/box.h"

#include <array>
#include <cstddef>
#include <span>

namespace granular
{
/// Returns true if a box vector is finite and not zero.
bool has_length(const Twofold3& vector) noexcept;

/// Returns the part of one of at most three vectors that is perpendicular to the other vectors: its product with any
/// vector counts how many times the chosen vector is in it. Zero if there is no such part, to twelve digits.
Vector3 own_part(std::span<const Vector3> vectors, std::size_t which) noexcept;

/// Returns the own part, divided by the square of its length: its product with any vector is the number of times that the
/// chosen vector is in it. Zero if there is no own part.
Vector3 dual_of(std::span<const Vector3> vectors, std::size_t which) noexcept;

/// Returns the duals of the periodic vectors of a box, given by its flags and any vectors of its lattice; zero along axes that
/// are not periodic, or whose vector has no length.
std::array<Vector3, 3> periodic_duals(
  const Box& box, const std::array<Vector3, 3>& vectors) noexcept;
}
#endif
