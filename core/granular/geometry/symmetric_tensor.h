// SPDX-License-Identifier: BSD-3-Clause
#ifndef granular_geometry_symmetric_tensor_h
#define granular_geometry_symmetric_tensor_h

#include "granular/geometry/box.h"

#include <array>

namespace granular
{
/// A symmetric tensor: xx yy zz xy xz yz, as compute stress/atom orders them.
using SymmetricTensor = std::array<double, 6>;

/// Returns the principal values, the largest first, to some ulps of the one that is largest in magnitude; nan if the tensor
/// is not finite.
Vector3 principal_values(SymmetricTensor tensor) noexcept;

/// Returns the equivalent stress of R. von Mises: sqrt(3/2 s:s) with the deviator s.
double von_mises(SymmetricTensor tensor) noexcept;
}
#endif
