// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_geometry_exact_determinant_h
#define granular_geometry_exact_determinant_h

#include "granular/geometry/box.h"
#include "granular/geometry/expansion.h"

#include <array>

namespace granular
{
/// A vector whose components are exact sums of a few doubles.
using ExactVector = std::array<Expansion<8>, 3>;

ExactVector exact_vector(const Twofold3& vector) noexcept;

/// Room for six permutations, products of three components, and four terms of each component.
using ExactDeterminant = Expansion<6 * 8 * 2 * 2 * 4>;

/// Returns the exact determinant of three vectors, as long as no product of three components underflows. Components of
/// b and c are sums of at most two doubles.
ExactDeterminant determinant(
  const ExactVector& a, const ExactVector& b, const ExactVector& c) noexcept;
}
#endif
