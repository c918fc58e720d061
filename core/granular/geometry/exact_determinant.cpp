// SPDX-License-Identifier: BSD-3-Clause
#include "granular/geometry/exact_determinant.h"

namespace granular
{
ExactVector exact_vector(const Twofold3& vector) noexcept
{
  ExactVector exact;
  for (std::size_t k = 0; k < 3; ++k)
  {
    exact[k].add(vector[k]);
  }
  return exact;
}

ExactDeterminant determinant(
  const ExactVector& a, const ExactVector& b, const ExactVector& c) noexcept
{
  constexpr std::size_t orders[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 0, 2, 1 },
    { 2, 1, 0 }, { 1, 0, 2 } };
  ExactDeterminant sum;
  for (std::size_t order = 0; order < 6; ++order)
  {
    const auto& [i, j, k] = orders[order];
    const double sign = order < 3 ? 1 : -1;
    for (const double x : a[i].parts())
    {
      for (const double y : b[j].parts())
      {
        const double product = sign * x * y;
        const double rest = std::fma(sign * x, y, -product);
        for (const double z : c[k].parts())
        {
          sum.add_product(rest, z);
          sum.add_product(product, z);
        }
      }
    }
  }
  return sum;
}
}
