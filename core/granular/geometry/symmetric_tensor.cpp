// SPDX-License-Identifier: BSD-3-Clause
#include "granular/geometry/symmetric_tensor.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace granular
{
namespace
{
using Matrix = std::array<Vector3, 3>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Divides a tensor by a power of two, so that nothing over- or underflows. Returns false if it is not finite.
bool scale(SymmetricTensor& tensor, int& power) noexcept
{
  double largest = 0;
  for (const double value : tensor)
  {
    largest = std::isfinite(value) ? std::max(largest, std::abs(value)) : HUGE_VAL;
  }
  power = largest > 0 ? std::ilogb(largest) : 0;
  for (double& value : tensor)
  {
    value = std::ldexp(value, -power);
  }
  return largest < HUGE_VAL;
}

/// Turns the axes p and q so that a[p][q] becomes 0 (C. G. J. Jacobi, J. Reine Angew. Math. 30, 1846).
void rotate(Matrix& a, std::size_t p, std::size_t q) noexcept
{
  if (a[p][q] == 0)
  {
    return;
  }
  const double half = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double tangent = std::copysign(1.0, half) / (std::abs(half) + std::hypot(1.0, half));
  const double cosine = 1 / std::hypot(1.0, tangent);
  const double sine = tangent * cosine;
  const std::size_t r = 3 - p - q;
  const double shift = tangent * a[p][q];
  a[p][p] -= shift;
  a[q][q] += shift;
  a[p][q] = a[q][p] = 0;
  const double rp = a[r][p];
  const double rq = a[r][q];
  a[r][p] = a[p][r] = cosine * rp - sine * rq;
  a[r][q] = a[q][r] = sine * rp + cosine * rq;
}
}

Vector3 principal_values(SymmetricTensor tensor) noexcept
{
  int power = 0;
  if (!scale(tensor, power))
  {
    return { nan, nan, nan };
  }
  const auto& [xx, yy, zz, xy, xz, yz] = tensor;
  Matrix a = { { { xx, xy, xz }, { xy, yy, yz }, { xz, yz, zz } } };
  for (int sweep = 0; sweep < 12 && (a[0][1] != 0 || a[0][2] != 0 || a[1][2] != 0); ++sweep)
  {
    rotate(a, 0, 1);
    rotate(a, 0, 2);
    rotate(a, 1, 2);
  }
  Vector3 values = { std::ldexp(a[0][0], power), std::ldexp(a[1][1], power),
    std::ldexp(a[2][2], power) };
  std::ranges::sort(values, std::greater<>());
  return values;
}

double von_mises(SymmetricTensor tensor) noexcept
{
  int power = 0;
  if (!scale(tensor, power))
  {
    return nan;
  }
  const auto& [xx, yy, zz, xy, xz, yz] = tensor;
  const double normal = (xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx);
  return std::ldexp(std::sqrt(normal / 2 + 3 * (xy * xy + xz * xz + yz * yz)), power);
}
}
