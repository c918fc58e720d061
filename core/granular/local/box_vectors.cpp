// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/box_vectors.h"

#include <array>
#include <cmath>

namespace granular
{
namespace
{
/// Makes a vector perpendicular to another one.
void remove_part(Vector3& vector, const Vector3& along) noexcept
{
  const double part = dot(vector, along) / dot(along, along);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    vector[axis] -= part * along[axis];
  }
}
}

bool has_length(const Twofold3& vector) noexcept
{
  const auto [x, y, z] = values_of(vector);
  return std::isfinite(x) && std::isfinite(y) && std::isfinite(z) && (x != 0 || y != 0 || z != 0);
}

Vector3 own_part(std::span<const Vector3> vectors, std::size_t which) noexcept
{
  Vector3 own = vectors[which];
  std::array<Vector3, 2> others;
  std::size_t count = 0;
  for (std::size_t i = 0; i < vectors.size(); ++i)
  {
    if (i != which)
    {
      others[count] = vectors[i];
      if (count == 1)
      {
        remove_part(others[1], others[0]);
      }
      remove_part(own, others[count++]);
    }
  }
  const bool is_one = dot(own, own) > 0x1p-80 * dot(vectors[which], vectors[which]);
  return is_one ? own : Vector3{};
}
}
