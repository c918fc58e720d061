// SPDX-License-Identifier: BSD-3-Clause
// Scaled coordinates in general cells that are nearly flat, against determinants of exact sums.
#include "granular/geometry/positions.h"
#include "granular/particles/point_forms.h"

#include "../support/big_sum.h"
#include "../support/quad.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace
{
using granular::Vector3;

/// The sum and the magnitudes of the terms of a determinant: six products of three doubles.
Exact determinant(const Vector3& a, const Vector3& b, const Vector3& c)
{
  BigSum sum;
  Exact result;
  constexpr int orders[6][3] = { { 0, 1, 2 }, { 1, 2, 0 }, { 2, 0, 1 }, { 0, 2, 1 }, { 2, 1, 0 },
    { 1, 0, 2 } };
  for (int order = 0; order < 6; ++order)
  {
    const auto& [i, j, k] = orders[order];
    const double x = order < 3 ? a[static_cast<std::size_t>(i)] : -a[static_cast<std::size_t>(i)];
    const double y = b[static_cast<std::size_t>(j)];
    const double z = c[static_cast<std::size_t>(k)];
    const double product = x * y;
    for (const double part : { product, std::fma(x, y, -product) })
    {
      sum.add(part * z);
      sum.add(std::fma(part, z, -(part * z)));
    }
    result.terms += absolute(static_cast<Quad>(x) * static_cast<Quad>(y) * static_cast<Quad>(z));
  }
  for (int part = 0; part < 3; ++part) // 159 bits
  {
    const double value = sum.value();
    result.value += static_cast<Quad>(value);
    sum.add(-value);
  }
  return result;
}

struct Worst
{
  double ratio = 0;    ///< of the error, in units of the bound
  double flatness = 0; ///< of the volume: terms by what is left of them
};

/// Cells whose third vector is in the plane of the others but for some last bits.
Worst scale_in_flat_cells(double thickness, int cells)
{
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto vector = [&](double size) {
    return Vector3{ size * unit(random), size * unit(random), size * unit(random) };
  };
  Worst worst;
  for (int cell = 0; cell < cells; ++cell)
  {
    std::array<Vector3, 3> v = { vector(1), vector(1), vector(thickness) };
    const double a = unit(random);
    const double b = unit(random);
    for (std::size_t k = 0; k < 3; ++k)
    {
      v[2][k] += a * v[0][k] + b * v[1][k];
    }
    std::rotate(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(random() % 3), v.end());
    const Exact volume = determinant(v[0], v[1], v[2]);
    if (volume.value == 0)
    {
      continue;
    }
    worst.flatness =
      std::max(worst.flatness, static_cast<double>(volume.terms / absolute(volume.value)));
    const Vector3 point = vector(2);
    std::vector<double> scaled(point.begin(), point.end());
    granular::convert_positions(
      granular::plan_form(granular::Coordinates::Absolute, granular::ColumnRole::ScaledPosition),
      granular::Box::from_vectors({}, v), {}, {}, scaled);
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Exact part = determinant(point, v[(k + 1) % 3], v[(k + 2) % 3]);
      worst.ratio = std::max(worst.ratio, error_in_bounds(scaled[k], part / volume));
    }
  }
  return worst;
}
}

TEST(FlatCells, CoordinatesAreWithinTheBoundOfAllConversions)
{
  double flattest = 0;
  for (const double thickness : { 1., 1e-3, 1e-6, 1e-9, 1e-12, 1e-14, 0. })
  {
    const Worst worst = scale_in_flat_cells(thickness, 20000);
    EXPECT_LE(worst.ratio, 1) << "in units of the bound, cells of thickness " << thickness;
    flattest = std::max(flattest, worst.flatness);
  }
  EXPECT_GT(flattest, 1e15) << "the numbers are too easy";
}
