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

double largest_in(const SymmetricTensor& tensor) noexcept
{
  double largest = 0;
  for (const double value : tensor)
  {
    largest = std::isnan(value) ? value : std::max(largest, std::abs(value));
    if (std::isnan(largest))
    {
      break;
    }
  }
  return largest;
}

SymmetricTensor scaled(const SymmetricTensor& tensor, int power) noexcept
{
  SymmetricTensor result;
  std::ranges::transform(
    tensor, result.begin(), [&](double value) { return std::ldexp(value, power); });
  return result;
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

Vector3 principal_values(const SymmetricTensor& tensor) noexcept
{
  const double largest = largest_in(tensor);
  if (!std::isfinite(largest))
  {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return { nan, nan, nan };
  }
  const int power = largest > 0 ? std::ilogb(largest) : 0; // nothing over- or underflows then
  const auto [xx, yy, zz, xy, xz, yz] = scaled(tensor, -power);
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

double von_mises(const SymmetricTensor& tensor) noexcept
{
  const double largest = largest_in(tensor);
  if (!std::isfinite(largest))
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const int power = largest > 0 ? std::ilogb(largest) : 0;
  const auto [xx, yy, zz, xy, xz, yz] = scaled(tensor, -power);
  const double normal = (xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx);
  return std::ldexp(std::sqrt(normal / 2 + 3 * (xy * xy + xz * xz + yz * yz)), power);
}
}
