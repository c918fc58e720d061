// SPDX-License-Identifier: BSD-3-Clause
#include "granular/local/box_vectors.h"

#include "granular/particles/point_forms.h"

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

Vector3 dual_of(std::span<const Vector3> vectors, std::size_t which) noexcept
{
  const Vector3 own = own_part(vectors, which);
  const double square = dot(own, own);
  return square > 0 ? Vector3{ own[0] / square, own[1] / square, own[2] / square } : Vector3{};
}

std::array<Vector3, 3> periodic_duals(
  const Box& box, const std::array<Vector3, 3>& vectors) noexcept
{
  std::array<Vector3, 3> periodic;
  std::array<std::size_t, 3> axes = {};
  std::size_t count = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (is_periodic(box, axis) && has_length(box.vectors[axis]))
    {
      periodic[count] = vectors[axis];
      axes[count++] = axis;
    }
  }
  std::array<Vector3, 3> duals = {};
  for (std::size_t i = 0; i < count; ++i)
  {
    duals[axes[i]] = dual_of({ periodic.data(), count }, i);
  }
  return duals;
}
}
