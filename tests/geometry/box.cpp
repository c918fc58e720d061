// SPDX-License-Identifier: BSD-3-Clause
#include "granular/geometry/box.h"

#include "../support/quad.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace
{
using granular::Box;
using granular::Twofold;
using granular::Vector3;

Quad quad(Twofold value)
{
  return static_cast<Quad>(value.hi) + static_cast<Quad>(value.lo);
}

/// How far a value of two doubles is from the exact one, in units of 2^-100 * sum of |terms|.
double miss(Twofold got, const Exact& exact)
{
  const Quad unit = exact.terms * static_cast<Quad>(0x1p-100);
  const Quad distance = absolute(quad(got) - exact.value);
  return distance == 0 ? 0 : static_cast<double>(distance / unit);
}

/// LAMMPS' formulas (documentation, "Triclinic simulation boxes"), in 113 bits.
double worst_miss_of_tilted(
  const Box& box, const Vector3& lo, const Vector3& hi, double xy, double xz, double yz)
{
  const Exact both = Exact(xy) + Exact(xz);
  const Exact xlo = Exact(lo[0]) - least({ 0.0, xy, xz, both });
  const Exact xhi = Exact(hi[0]) - greatest({ 0.0, xy, xz, both });
  const Exact ylo = Exact(lo[1]) - least({ 0.0, yz });
  const Exact yhi = Exact(hi[1]) - greatest({ 0.0, yz });
  return std::max({ miss(box.origin[0], xlo), miss(box.origin[1], ylo), miss(box.origin[2], lo[2]),
    miss(box.vectors[0][0], xhi - xlo), miss(box.vectors[1][1], yhi - ylo),
    miss(box.vectors[2][2], Exact(hi[2]) - Exact(lo[2])), miss(box.vectors[1][0], xy),
    miss(box.vectors[2][0], xz), miss(box.vectors[2][1], yz), miss(box.vectors[0][1], 0.0),
    miss(box.vectors[0][2], 0.0), miss(box.vectors[1][2], 0.0) });
}
}

TEST(Box, FromBounds)
{
  const Box box = Box::from_bounds({ 0, -1, 1e6 }, { 2, 1, 1e6 + 0.0625 });
  EXPECT_FALSE(box.tilted);
  EXPECT_FALSE(box.general);
  EXPECT_EQ(box.corner(0, 0, 0), (Vector3{ 0, -1, 1e6 }));
  EXPECT_EQ(box.corner(1, 0, 0), (Vector3{ 2, -1, 1e6 }));
  EXPECT_EQ(box.corner(1, 1, 1), (Vector3{ 2, 1, 1e6 + 0.0625 }));
}

TEST(Box, OfBoundsIsExactToTheLastBit)
{
  // the length 0.1 + 1e6 - 1e-17 has more bits than a double
  const Vector3 lo = { -0.1, 1e-17, -1e6 };
  const Vector3 hi = { 1e6, 1e6, 1e-30 };
  const Box box = Box::from_bounds(lo, hi);
  for (std::size_t k = 0; k < 3; ++k)
  {
    EXPECT_LE(miss(box.vectors[k][k], Exact(hi[k]) - Exact(lo[k])), 1) << k;
  }
  EXPECT_EQ(box.corner(1, 1, 1), hi);
}

// By hand: xlo = xlo_bound - min(0, xy, xz, xy + xz) and so on.
TEST(Box, TrapTheBoundsOfATiltedBoxAreNotItsCorners)
{
  const Box box = Box::from_tilted_bounds({ -3, 0, 0 }, { 12, 14, 5 }, 2, -3, 4);
  EXPECT_TRUE(box.tilted);
  EXPECT_FALSE(box.general);
  EXPECT_EQ(box.corner(0, 0, 0), (Vector3{ 0, 0, 0 }));
  EXPECT_EQ(box.corner(1, 0, 0), (Vector3{ 10, 0, 0 }));
  EXPECT_EQ(box.corner(0, 1, 0), (Vector3{ 2, 10, 0 }));
  EXPECT_EQ(box.corner(0, 0, 1), (Vector3{ -3, 4, 5 }));
  EXPECT_EQ(box.corner(1, 1, 1), (Vector3{ 9, 14, 5 }));
}

TEST(Box, EverySignOfTheTilts)
{
  for (const double xy : { -2.5, 0.0, 2.5 })
  {
    for (const double xz : { -1.25, -2.5, 0.0, 1.25, 2.5 })
    {
      for (const double yz : { -0.5, 0.0, 0.5 })
      {
        const Vector3 lo = { -7, -7, -7 };
        const Vector3 hi = { 7, 7, 7 };
        const Box box = Box::from_tilted_bounds(lo, hi, xy, xz, yz);
        EXPECT_EQ(worst_miss_of_tilted(box, lo, hi, xy, xz, yz), 0);
        // the corners reach the bounds and do not leave them
        Vector3 least = box.corner(0, 0, 0);
        Vector3 most = least;
        for (int corner = 1; corner < 8; ++corner)
        {
          const Vector3 point = box.corner(corner & 1, corner >> 1 & 1, corner >> 2);
          for (std::size_t k = 0; k < 3; ++k)
          {
            least[k] = std::min(least[k], point[k]);
            most[k] = std::max(most[k], point[k]);
          }
        }
        EXPECT_EQ(least, lo) << xy << " " << xz << " " << yz;
        EXPECT_EQ(most, hi) << xy << " " << xz << " " << yz;
      }
    }
  }
}

TEST(Box, HardTiltedBoxes)
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  double worst = 0;
  for (int i = 0; i < 100'000; ++i)
  {
    const double size = std::pow(10.0, 6 * unit(random));
    const double place = i % 3 == 0 ? 0 : 1e6 * unit(random);
    const double tilt = i % 2 == 0 ? size : 1e6 * size;
    Vector3 lo;
    Vector3 hi;
    for (std::size_t k = 0; k < 3; ++k)
    {
      lo[k] = place + size * unit(random);
      hi[k] = lo[k] + size * (1 + unit(random));
    }
    const double xy = tilt * unit(random);
    const double xz = i % 5 == 0 ? -xy : tilt * unit(random);
    const double yz = tilt * unit(random);
    const Box box = Box::from_tilted_bounds(lo, hi, xy, xz, yz);
    worst = std::max(worst, worst_miss_of_tilted(box, lo, hi, xy, xz, yz));
  }
  EXPECT_LE(worst, 1) << "in units of 2^-100 * sum of |terms|";
}

TEST(Box, FromVectors)
{
  const Box box = Box::from_vectors(
    { 1, 2, 3 }, { Vector3{ 4, 1, 0 }, Vector3{ -1, 5, 0.5 }, Vector3{ 0, 0, 6 } });
  EXPECT_TRUE(box.tilted);
  EXPECT_TRUE(box.general);
  EXPECT_EQ(box.corner(0, 0, 0), (Vector3{ 1, 2, 3 }));
  EXPECT_EQ(box.corner(1, 0, 0), (Vector3{ 5, 3, 3 }));
  EXPECT_EQ(box.corner(0, 1, 0), (Vector3{ 0, 7, 3.5 }));
  EXPECT_EQ(box.corner(1, 1, 1), (Vector3{ 4, 8, 9.5 }));
}

TEST(Box, CornersAreRoundedOnce)
{
  const Vector3 lo = { 1e6, 0.1, -1e-3 };
  const Vector3 hi = { 1e6 + 0.01, 0.3, 1e9 };
  const double xy = 1e4 / 3;
  const double xz = -1e4 / 7;
  const Vector3 high = { hi[0] + 1e5, hi[1], hi[2] };
  const Box box = Box::from_tilted_bounds(lo, high, xy, xz, 0.05);
  const Exact x =
    Exact(high[0]) - greatest({ 0.0, xy, xz, Exact(xy) + Exact(xz) }) + Exact(xy) + Exact(xz);
  EXPECT_EQ(box.corner(1, 1, 1)[0], static_cast<double>(x.value));
  EXPECT_EQ(box.corner(1, 1, 1)[1], hi[1]);
  EXPECT_EQ(box.corner(1, 1, 1)[2], hi[2]);
}

TEST(Box, TrapBoundsThatAreNoNumbers)
{
  const double inf = std::numeric_limits<double>::infinity();
  const Box box = Box::from_bounds({ -inf, 0, std::nan("") }, { inf, inf, 1 });
  EXPECT_EQ(box.corner(0, 0, 0)[0], -inf);
  EXPECT_EQ(box.corner(0, 0, 0)[1], 0);
  EXPECT_TRUE(std::isnan(box.corner(0, 0, 0)[2]));
  EXPECT_EQ(box.corner(0, 1, 0)[1], inf);
}
