// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_local_dual_vector_h
#define granular_local_dual_vector_h

#include "granular/base/box.h"

#include <cstddef>
#include <optional>
#include <span>

namespace granular
{
inline double dot(const Vector3& a, const Vector3& b) noexcept
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Whether a vector of a box is one: not zero, and finite.
bool has_length(const Twofold3& vector) noexcept;

/// What its product with one of at most three vectors is 1, with the others 0: by its product with any vector it tells
/// how many of that one are in it. None where the vector does not stand out from the others, to a few digits.
std::optional<Vector3> dual_vector(std::span<const Vector3> vectors, std::size_t which) noexcept;
}
#endif
