// SPDX-License-Identifier: BSD-3-Clause
// Particles to count, and counts by the plainest means.
#ifndef tests_decomposition_counted_frames_h
#define tests_decomposition_counted_frames_h

#include "granular/subdomains/count_particles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <random>
#include <span>
#include <tuple>
#include <vector>

using Points = std::vector<granular::Vector3>;

/// A frame without a box: points count as they are.
inline granular::FrameView frame_of(const Points& points)
{
  granular::FrameView frame;
  frame.has_box = false;
  frame.rows = static_cast<std::int64_t>(points.size());
  frame.points = granular::view_rows(
    "points", granular::ValueType::Float64, reinterpret_cast<const double*>(points.data()), 3);
  return frame;
}

inline granular::ParticleCounts count(
  const granular::FrameView& frame, const granular::ProcessGrid& grid, int threads = 1)
{
  granular::Progress progress;
  return count_in_grid(frame, grid, granular::Executor(threads), progress);
}

inline granular::ParticleCounts count(const granular::FrameView& frame,
  std::span<const granular::Subdomain> subdomains, int threads = 1)
{
  granular::Progress progress;
  return count_in_subdomains(frame, subdomains, granular::Executor(threads), progress);
}

/// Every point against every subdomain: of those that have it between closed faces the one that has it below most
/// of its upper faces, of these the one that begins last along x, y and z, of these the last.
inline granular::ParticleCounts count_one_by_one(
  const Points& points, std::span<const granular::Subdomain> subdomains)
{
  granular::ParticleCounts counts;
  counts.particles.resize(subdomains.size());
  for (const auto& [x, y, z] : points)
  {
    using Rank = std::tuple<int, double, double, double, std::size_t>;
    Rank best = { -1, 0, 0, 0, 0 };
    for (std::size_t i = 0; i < subdomains.size(); ++i)
    {
      const auto& [lo, hi, particles, rank] = subdomains[i];
      if (lo[0] <= x && x <= hi[0] && lo[1] <= y && y <= hi[1] && lo[2] <= z && z <= hi[2] &&
        std::isfinite(x) && std::isfinite(y) && std::isfinite(z))
      {
        const int below = (x < hi[0] ? 1 : 0) + (y < hi[1] ? 1 : 0) + (z < hi[2] ? 1 : 0);
        best = std::max(best, Rank{ below, lo[0], lo[1], lo[2], i });
      }
    }
    ++(std::get<0>(best) < 0 ? counts.outside : counts.particles[std::get<4>(best)]);
  }
  return counts;
}

/// The place along one axis by the rule alone: the number of cuts between the ends that are not above x.
inline std::int64_t slab_one_by_one(const std::vector<double>& cuts, double x)
{
  if (!(cuts.front() <= x && x <= cuts.back()))
  {
    return -1;
  }
  return std::count_if(cuts.begin() + 1, cuts.end() - 1, [x](double cut) { return cut <= x; });
}

inline granular::ParticleCounts count_by_cuts(
  const Points& points, const granular::ProcessGrid& grid)
{
  granular::ParticleCounts counts;
  counts.particles.resize(static_cast<std::size_t>(grid.size()));
  const std::int64_t py = grid.counts()[1];
  const std::int64_t pz = grid.counts()[2];
  for (const granular::Vector3& x : points)
  {
    std::array<std::int64_t, 3> at = {};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      at[axis] = slab_one_by_one(grid.cuts[axis], x[axis]);
    }
    const auto [i, j, k] = at;
    ++(std::min({ i, j, k }) < 0
        ? counts.outside
        : counts.particles[static_cast<std::size_t>((i * py + j) * pz + k)]);
  }
  return counts;
}

/// Coordinates that tell right from nearly right: each number, and one ulp beside.
inline std::vector<double> beside(const std::vector<double>& numbers)
{
  std::vector<double> all;
  for (const double number : numbers)
  {
    all.insert(
      all.end(), { std::nextafter(number, -HUGE_VAL), number, std::nextafter(number, HUGE_VAL) });
  }
  return all;
}

/// Points that have each coordinate from a list, or now and then from anywhere between lo and hi.
inline Points chosen_points(std::size_t count, const std::array<std::vector<double>, 3>& chosen,
  const granular::Vector3& lo, const granular::Vector3& hi, std::mt19937_64& random)
{
  Points points(count);
  for (granular::Vector3& point : points)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const std::vector<double>& numbers = chosen[axis];
      const double part = std::generate_canonical<double, 53>(random);
      point[axis] = random() % 2 == 0 || numbers.empty() ? lo[axis] + part * (hi[axis] - lo[axis])
                                                         : numbers[random() % numbers.size()];
    }
  }
  return points;
}

#endif
