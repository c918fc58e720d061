// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_box_vectors_h
#define granular_local_box_vectors_h

#include "granular/geometry/box.h"

#include <cstddef>
#include <span>

namespace granular
{
/// Returns true if a box vector is finite and not zero.
bool has_length(const Twofold3& vector) noexcept;

/// Returns the part of one of at most three vectors that is perpendicular to the other vectors: its product with any
/// vector counts how many times the chosen vector is in it. Zero if there is no such part, to twelve digits.
Vector3 own_part(std::span<const Vector3> vectors, std::size_t which) noexcept;
}
#endif
