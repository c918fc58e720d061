// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/decomposition/voxels.h"

#include "../grid/made_subdomains.h"
#include "../support/hard_case.h"
#include "../support/stop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

using namespace granular;

namespace
{
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

using Corners = std::array<Vector3, corners_of_voxel>;

/// The arrays of voxels, by value.
struct Made
{
  std::vector<Vector3> points;
  std::vector<std::array<std::int64_t, corners_of_voxel>> cells;

  explicit Made(const Subdomains& subdomains, const Vector3& origin = {}, int threads = 1,
    const std::shared_ptr<BlockPool>& pool = nullptr)
  {
    Progress progress;
    const Voxels voxels = make_voxels(subdomains, origin, Executor(threads), progress, pool);
    EXPECT_EQ(voxels.points.bytes(), 24 * static_cast<std::size_t>(voxels.number_of_points));
    EXPECT_EQ(voxels.connectivity.bytes(), 64 * subdomains.size());
    const auto* point = static_cast<const Vector3*>(voxels.points.data());
    points.assign(point, point + voxels.number_of_points);
    const auto* cell =
      static_cast<const std::array<std::int64_t, corners_of_voxel>*>(voxels.connectivity.data());
    cells.assign(cell, cell + subdomains.size());
  }

  bool operator==(const Made&) const = default;

  /// Of a cell, in its order.
  Corners corners(std::size_t cell) const
  {
    Corners corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
      corners[i] = points.at(static_cast<std::size_t>(cells[cell][i]));
    }
    return corners;
  }
};

/// Each cell has the corners that a VTK_VOXEL of its subdomain has: i + 2j + 4k.
void expect_voxels(const Made& made, const Subdomains& subdomains, const Vector3& origin = {})
{
  ASSERT_EQ(made.cells.size(), subdomains.size());
  for (std::size_t p = 0; p < subdomains.size(); ++p)
  {
    const Corners corners = made.corners(p);
    for (std::size_t n = 0; n < corners.size(); ++n)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const Vector3& bounds = n >> axis & 1 ? subdomains[p].hi : subdomains[p].lo;
        EXPECT_EQ(corners[n][axis], bounds[axis] - origin[axis]);
      }
    }
  }
}

Corners in_order(
  const std::array<int, corners_of_voxel>& sides, const Vector3& lo, const Vector3& hi)
{
  Corners corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      corners[i][axis] = sides[i] >> axis & 1 ? hi[axis] : lo[axis];
    }
  }
  return corners;
}

constexpr std::array<int, corners_of_voxel> voxel_order = { 0, 1, 2, 3, 4, 5, 6, 7 };
constexpr std::array<int, corners_of_voxel> hexahedron_order = { 0, 1, 3, 2, 4, 5, 7, 6 };
}

/// The file of LIGGGHTS numbers the corners of process p as 8p + 4i + 2j + k.
TEST(MakeVoxels, one_process)
{
  const Made made({ made_subdomain({ 1, 2, 3 }, { 10, 20, 30 }) });
  const std::vector<Vector3> points = { { 1, 2, 3 }, { 1, 2, 30 }, { 1, 20, 3 }, { 1, 20, 30 },
    { 10, 2, 3 }, { 10, 2, 30 }, { 10, 20, 3 }, { 10, 20, 30 } };
  EXPECT_EQ(made.points, points);
  const std::array<std::int64_t, 8> cell = { 0, 4, 2, 6, 1, 5, 3, 7 };
  EXPECT_EQ(made.cells.at(0), cell);
}

TEST(MakeVoxels, grid)
{
  const Subdomains subdomains = made_grid({ 4, 3, 5 });
  const Made made(subdomains);
  expect_voxels(made, subdomains);
  EXPECT_EQ(made.points.size(), 8 * 60);
}

TEST(MakeVoxels, nothing)
{
  EXPECT_TRUE(Made({}).points.empty());
}

TEST(MakeVoxels, odd_bounds)
{
  const Subdomains flat = { made_subdomain({ 0, 0, 2 }, { 1, 1, 2 }),
    made_subdomain({ 5, 5, 5 }, { 5, 5, 5 }) };
  expect_voxels(Made(flat), flat);
  const Subdomains odd = { made_subdomain({ no_number, 0, 0 }, { 1, 1, infinity }) };
  EXPECT_EQ(Made(odd).points.size(), 8);
  const Subdomains inverted = { made_subdomain({ 1, 1, 1 }, { 0, 0, 0 }) };
  expect_voxels(Made(inverted), inverted);
}

/// Far away the origin is subtracted with one rounding.
TEST(MakeVoxels, origin)
{
  const Vector3 origin = { 1e9, -0.1, 1e16 };
  const Subdomains subdomains = { made_subdomain({ 1e9, 0.1, 1 }, { 1e9 + 1e-6, 0.3, 2 }),
    made_subdomain({ 1e9 + 1e-6, 0.1, 1 }, { 1e9 + 2e-6, 0.3, 2 }) };
  const Made made(subdomains, origin);
  expect_voxels(made, subdomains, origin);
  EXPECT_EQ(made.points[0][2], -1e16); // both z of the box became this one
}

TEST(MakeVoxels, threads)
{
  const Subdomains subdomains = made_bisection(50000, 4);
  const Vector3 origin = { 0.25, 0.5, 0.75 };
  const auto pool = std::make_shared<BlockPool>(std::size_t{ 1 } << 30);
  const Made alone(subdomains, origin);
  for (const int threads : { 2, 3 })
  {
    EXPECT_EQ(Made(subdomains, origin, threads, pool), alone);
  }
}

TEST(MakeVoxels, tells_and_stops)
{
  const Subdomains subdomains = made_bisection(200'000, 4);
  Stop all;
  make_voxels(subdomains, { 1, 0, 0 }, Executor(1), all);
  EXPECT_GT(all.reports, 10);
  EXPECT_GT(all.last, 0.9);
  Stop half(all.reports / 2);
  EXPECT_THROW(make_voxels(subdomains, { 1, 0, 0 }, Executor(1), half), Cancelled);
}

TEST(MakeVoxels, a_million)
{
  const Subdomains subdomains = made_grid({ 100, 100, 100 });
  Progress progress;
  const Voxels voxels = make_voxels(subdomains, {}, Executor(1), progress);
  EXPECT_EQ(voxels.number_of_points, 8'000'000);
  const auto* points = static_cast<const Vector3*>(voxels.points.data());
  const auto* cells = static_cast<const std::int64_t*>(voxels.connectivity.data());
  for (const std::size_t p : { std::size_t{ 0 }, std::size_t{ 500'000 }, std::size_t{ 999'999 } })
  {
    EXPECT_EQ(points[cells[8 * p]], subdomains[p].lo);
    EXPECT_EQ(points[cells[8 * p + 7]], subdomains[p].hi);
  }
}

TEST(BoundsOfCell, orders)
{
  const Vector3 lo = { -1, 0, 1e9 };
  const Vector3 hi = { 2, 1e-300, 1e9 + 1 };
  Subdomain found = { {}, {}, 12, 3 };
  EXPECT_EQ(bounds_of_cell(in_order(voxel_order, lo, hi), found), CornerOrder::Voxel);
  EXPECT_EQ(found, made_subdomain(lo, hi, 12, 3));
  found = {};
  EXPECT_EQ(bounds_of_cell(in_order(hexahedron_order, lo, hi), found), CornerOrder::Hexahedron);
  EXPECT_EQ(found, made_subdomain(lo, hi));
  found = {};
  // as LIGGGHTS-INL writes them: x0y0z0 x0y0z1 x0y1z0 x0y1z1 x1y0z0 ...
  EXPECT_EQ(
    bounds_of_cell(in_order({ 0, 4, 2, 6, 1, 5, 3, 7 }, lo, hi), found), CornerOrder::Reflected);
  EXPECT_EQ(found, made_subdomain(lo, hi));
}

/// Of all corners the farthest from the first.
Vector3 opposite(const Corners& corners)
{
  return *std::max_element(corners.begin(), corners.end(),
    [&](const Vector3& a, const Vector3& b)
    {
      const auto distance = [&](const Vector3& corner)
      {
        return std::abs(corner[0] - corners[0][0]) + std::abs(corner[1] - corners[0][1]) +
          std::abs(corner[2] - corners[0][2]);
      };
      return distance(a) < distance(b);
    });
}

/// All ways to turn and mirror a cell: axes in another order, and directions reversed, which gives inverted bounds.
TEST(BoundsOfCell, symmetries)
{
  const Vector3 lo = { 0, 10, 100 };
  const Vector3 hi = { 1, 12, 103 };
  std::map<CornerOrder, int> seen;
  HardCase wrong("voxels",
    "cells in all 96 orders of corners, also mirrored as LIGGGHTS-INL writes them: taken for "
    "another "
    "box",
    "orders", 0);
  for (const auto& order : { voxel_order, hexahedron_order })
  {
    std::array<std::size_t, 3> axes = { 0, 1, 2 };
    do
    {
      for (unsigned reversed = 0; reversed < 8; ++reversed)
      {
        std::array<int, corners_of_voxel> sides = {};
        for (std::size_t i = 0; i < sides.size(); ++i)
        {
          for (std::size_t axis = 0; axis < 3; ++axis)
          {
            const unsigned side = (static_cast<unsigned>(order[i]) ^ reversed) >> axis & 1;
            sides[i] |= static_cast<int>(side << axes[axis]);
          }
        }
        Subdomain found = made_subdomain({ 7, 7, 7 }, { 8, 8, 8 });
        const Corners corners = in_order(sides, lo, hi);
        const CornerOrder is = bounds_of_cell(corners, found);
        ++seen[is];
        const bool same = axes == std::array<std::size_t, 3>{ 0, 1, 2 };
        const bool exchanged = axes == std::array<std::size_t, 3>{ 2, 1, 0 };
        const bool voxel = order == voxel_order;
        EXPECT_EQ(is == CornerOrder::Voxel, same && voxel);
        EXPECT_EQ(is == CornerOrder::Hexahedron, same && !voxel);
        EXPECT_EQ(is == CornerOrder::Reflected, exchanged && voxel);
        const bool none = is == CornerOrder::None;
        wrong.add(found.lo == (none ? Vector3({ 7, 7, 7 }) : corners.front()) &&
              found.hi == (none ? Vector3({ 8, 8, 8 }) : opposite(corners))
            ? 0
            : 1);
      }
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  EXPECT_EQ(seen[CornerOrder::None], 96 - 3 * 8);
}

TEST(BoundsOfCell, no_box)
{
  const Corners right = in_order(voxel_order, { 0, 0, 0 }, { 1, 2, 3 });
  Subdomain found;
  for (std::size_t i = 0; i < right.size(); ++i)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      for (const double value : { std::nextafter(right[i][axis], 9), 0.5, no_number, infinity })
      {
        Corners wrong = right;
        wrong[i][axis] = value;
        EXPECT_EQ(bounds_of_cell(wrong, found), CornerOrder::None);
      }
    }
  }
  EXPECT_EQ(found, Subdomain());
}

bool is_same(double a, double b)
{
  return a == b || (std::isnan(a) && std::isnan(b));
}

/// Whether bounds are right is for others to say.
TEST(BoundsOfCell, odd_bounds)
{
  const std::array<int, corners_of_voxel> mirrored = { 0, 4, 2, 6, 1, 5, 3, 7 };
  const Vector3 odd[][2] = { { { 0, 2, 0 }, { 1, 0, 3 } }, { { 3, 2, 1 }, { 0, 0, 0 } },
    { { 0, 0, no_number }, { 1, 2, 3 } }, { { 0, 0, 0 }, { 1, no_number, infinity } },
    { { no_number, 1, -infinity }, { 2, no_number, infinity } } };
  for (const auto& [lo, hi] : odd)
  {
    for (const auto& [order, known] :
      { std::pair{ voxel_order, CornerOrder::Voxel }, std::pair{ mirrored, CornerOrder::Reflected },
        std::pair{ hexahedron_order, CornerOrder::Hexahedron } })
    {
      Subdomain found;
      EXPECT_EQ(bounds_of_cell(in_order(order, lo, hi), found), known);
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        EXPECT_TRUE(is_same(found.lo[axis], lo[axis]) && is_same(found.hi[axis], hi[axis]));
      }
    }
  }
  // nan wherever one looks
  const Vector3 nowhere = { no_number, no_number, no_number };
  Subdomain found;
  EXPECT_EQ(bounds_of_cell(in_order(voxel_order, nowhere, nowhere), found), CornerOrder::Voxel);
}

TEST(BoundsOfCell, flat)
{
  Subdomain found;
  const Vector3 point = { 1, 2, 3 };
  EXPECT_EQ(bounds_of_cell(in_order(voxel_order, point, point), found), CornerOrder::Voxel);
  EXPECT_EQ(found, made_subdomain(point, point));
  const Vector3 wide = { 4, 5, 3 };
  EXPECT_EQ(bounds_of_cell(in_order(voxel_order, point, wide), found), CornerOrder::Voxel);
  EXPECT_EQ(found, made_subdomain(point, wide));
  EXPECT_EQ(
    bounds_of_cell(in_order(hexahedron_order, point, wide), found), CornerOrder::Hexahedron);
  EXPECT_EQ(bounds_of_cell(in_order({ 0, 4, 2, 6, 1, 5, 3, 7 }, point, wide), found),
    CornerOrder::Reflected);
  // a line along y: x and z exchanged make no difference
  const Vector3 line = { 1, 9, 3 };
  EXPECT_EQ(
    bounds_of_cell(in_order({ 0, 4, 2, 6, 1, 5, 3, 7 }, point, line), found), CornerOrder::Voxel);
  // -0 is 0
  Corners corners = in_order(voxel_order, { 0, 0, 0 }, { 1, 1, 1 });
  corners[4][0] = -0.0;
  EXPECT_EQ(bounds_of_cell(corners, found), CornerOrder::Voxel);
}
