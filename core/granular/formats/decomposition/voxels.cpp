// SPDX-License-Identifier: BSD-3-Clause
#include "granular/formats/decomposition/voxels.h"

#include <cmath>
#include <cstddef>

namespace granular
{
namespace
{
constexpr std::size_t corners = corners_of_voxel;
constexpr std::size_t subdomains_a_chunk = 16384;

bool is_same(double a, double b) noexcept
{
  return a == b || (std::isnan(a) && std::isnan(b));
}

/// The corners of a box in each CornerOrder: which bound each has along x (1), y (2) and z (4).
constexpr std::array<unsigned, corners> known_orders[] = {
  { 0, 1, 2, 3, 4, 5, 6, 7 },
  { 0, 4, 2, 6, 1, 5, 3, 7 },
  { 0, 1, 3, 2, 4, 5, 7, 6 },
};
}

Voxels make_voxels(std::span<const Subdomain> subdomains, const Vector3& origin,
  const Executor& executor, Progress& progress, const std::shared_ptr<BlockPool>& pool)
{
  const std::size_t all = corners * subdomains.size();
  Voxels voxels;
  voxels.points = Block(all * sizeof(Vector3), pool);
  voxels.connectivity = Block(all * sizeof(std::int64_t), pool);
  voxels.number_of_points = static_cast<std::int64_t>(all);
  double* const points = static_cast<double*>(voxels.points.data());
  auto* const connectivity = static_cast<std::int64_t*>(voxels.connectivity.data());
  executor.for_each_stretch(
    subdomains.size(), subdomains_a_chunk,
    [&](std::size_t begin, std::size_t count, std::size_t)
    {
      for (std::size_t p = begin; p < begin + count; ++p)
      {
        const Vector3& lo = subdomains[p].lo;
        const Vector3& hi = subdomains[p].hi;
        const double x[2] = { lo[0] - origin[0], hi[0] - origin[0] };
        const double y[2] = { lo[1] - origin[1], hi[1] - origin[1] };
        const double z[2] = { lo[2] - origin[2], hi[2] - origin[2] };
        double* const point = points + 3 * corners * p;
        std::int64_t* const cell = connectivity + corners * p;
        for (std::size_t i = 0; i < corners; ++i)
        {
          point[3 * i] = x[i >> 2];
          point[3 * i + 1] = y[i >> 1 & 1];
          point[3 * i + 2] = z[i & 1];
          cell[i] = static_cast<std::int64_t>(corners * p) + voxel_corners[i];
        }
      }
    },
    progress);
  return voxels;
}

CornerOrder bounds_of_cell(
  std::span<const Vector3, corners_of_voxel> points, Subdomain& subdomain) noexcept
{
  std::uint8_t order = 0;
  for (const auto& sides : known_orders)
  {
    Subdomain box;
    for (std::size_t i = 0; i < corners; ++i)
    {
      box.lo = sides[i] == 0 ? points[i] : box.lo;
      box.hi = sides[i] == 7 ? points[i] : box.hi;
    }
    bool right = true;
    for (std::size_t i = 0; i < corners; ++i)
    {
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        const bool high = (sides[i] >> axis & 1) != 0;
        right = right && is_same(points[i][axis], (high ? box.hi : box.lo)[axis]);
      }
    }
    if (right)
    {
      subdomain.lo = box.lo;
      subdomain.hi = box.hi;
      break;
    }
    ++order;
  }
  return static_cast<CornerOrder>(order);
}
}
