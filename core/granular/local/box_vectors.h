// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_box_vectors_h
#define granular_local_box_vectors_h

#include "granular/geometry/box.h"

#include <cstddef>
#include <span>

namespace granular
{
/// Whether a vector of a box is one: not zero, and finite.
bool has_length(const Twofold3& vector) noexcept;

/// The part of one of at most three vectors that is perpendicular to the others: its product with any vector tells how many
/// of that one are in it. Zero where there is no such part, to twelve digits.
Vector3 own_part(std::span<const Vector3> vectors, std::size_t which) noexcept;
}
#endif
