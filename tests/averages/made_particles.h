// SPDX-License-Identifier: BSD-3-Clause
// Grains to average, and averages by the plainest means.
#ifndef granular_tests_euler_made_particles_h
#define granular_tests_euler_made_particles_h

#include "../support/big_sum.h"

#include "granular/averages/average.h"
#include "granular/grid/sphere_box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

struct Particle
{
  granular::Vector3 x = {};
  granular::Vector3 v = {};
  double radius = 1;
  double mass = 1;
  std::array<double, 6> stress = {};
};

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Arrays of particles as a frame has them.
class Grains
{
public:
  explicit Grains(std::vector<Particle> particles)
    : all(std::move(particles))
  {
  }

  granular::FrameView frame(const granular::Box* box = nullptr) const
  {
    return this->frame(0, all.size(), box);
  }

  /// Rows [first, last).
  granular::FrameView frame(
    std::size_t first, std::size_t last, const granular::Box* box = nullptr) const
  {
    constexpr std::int64_t step = sizeof(Particle) / sizeof(double);
    const Particle* const particle = all.data() + first;
    const auto view = [&](const char* name, const double* values, int size)
    {
      granular::ArrayView array =
        granular::view_rows(name, granular::ValueType::Float64, values, size);
      array.step = step;
      return array;
    };
    granular::FrameView frame;
    frame.rows = static_cast<std::int64_t>(last - first);
    frame.has_box = box != nullptr;
    frame.header.box = box ? *box : granular::Box();
    frame.points = view("points", particle->x.data(), 3);
    frame.arrays = { view("v", particle->v.data(), 3), view("radius", &particle->radius, 1),
      view("mass", &particle->mass, 1), view("c_stress", particle->stress.data(), 6) };
    return frame;
  }

  std::vector<Particle> all;
};

inline granular::Box periodic_box(
  const granular::Vector3& lo, const granular::Vector3& hi, const char* boundary)
{
  granular::Box box = granular::Box::from_bounds(lo, hi);
  box.boundary = boundary;
  return box;
}

/// Grains all over a box, and somewhat beyond it.
inline std::vector<Particle> random_particles(std::size_t count, const granular::Vector3& lo,
  const granular::Vector3& hi, double radius, unsigned seed, double beyond = 0)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Particle> particles(count);
  for (Particle& particle : particles)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const double edge = hi[k] - lo[k];
      particle.x[k] = lo[k] + edge * ((1 + 2 * beyond) * unit(random) - beyond);
      particle.v[k] = unit(random) - 0.5;
    }
    particle.radius = radius * (0.5 + unit(random) / 2);
    particle.mass = 1e-3 * unit(random);
    for (double& value : particle.stress)
    {
      value = 1e-4 * (unit(random) - 0.7);
    }
  }
  return particles;
}

inline granular::EulerAverageRequest request_for(
  const granular::EulerGrid& grid, granular::CellWeights weights)
{
  granular::EulerAverageRequest request;
  request.grid = grid;
  request.cells.weights = weights;
  request.wanted = granular::WantedCells::all(grid);
  return request;
}

inline granular::EulerAverages average(const granular::FrameView& frame,
  const granular::EulerAverageRequest& request, int threads = 1,
  granular::Notices* notices = nullptr)
{
  granular::SerialCommunicator alone;
  granular::Progress progress;
  granular::Notices own;
  return granular::average_in_cells(
    frame, request, alone, granular::Executor(threads), notices ? *notices : own, progress);
}

/// The share of a particle in a cell, and the volume there.
using Share = std::pair<double, double>;

/// Every particle against every cell, with exact sums. share(particle, lo, hi of the cell, whether it is the last of each axis).
template <class ShareOf>
granular::EulerCells average_one_by_one(
  const std::vector<Particle>& particles, const granular::EulerGrid& grid, const ShareOf& share_of)
{
  granular::EulerCells cells;
  cells.resize(grid.size());
  cells.normal_stress.resize(static_cast<std::size_t>(3 * grid.size()));
  cells.shear_stress.resize(static_cast<std::size_t>(3 * grid.size()));
  std::size_t cell = 0;
  for (std::int64_t k = 0; k < grid.counts[2]; ++k)
  {
    for (std::int64_t j = 0; j < grid.counts[1]; ++j)
    {
      for (std::int64_t i = 0; i < grid.counts[0]; ++i, ++cell)
      {
        const std::array<std::int64_t, 3> at = { i, j, k };
        granular::Vector3 lo;
        granular::Vector3 hi;
        double size = 1;
        for (std::size_t a = 0; a < 3; ++a)
        {
          lo[a] = grid.face(a, at[a]);
          hi[a] = grid.face(a, at[a] + 1);
          size *= hi[a] - lo[a];
          cells.centres[3 * cell + a] = grid.centre(a, at[a]);
        }
        std::array<BigSum, 7> sums; // share, mass, momentum, radius, volume
        for (const Particle& particle : particles)
        {
          const auto [share, volume] = share_of(particle, lo, hi);
          const double mass = particle.mass * share;
          const double terms[] = { share, mass, mass * particle.v[0], mass * particle.v[1],
            mass * particle.v[2], particle.radius * share, volume };
          for (std::size_t n = 0; share > 0 && n < sums.size(); ++n)
          {
            sums[n].add(terms[n]);
          }
        }
        const double mass = sums[1].value();
        granular::Vector3 mean = {};
        for (std::size_t a = 0; a < 3; ++a)
        {
          mean[a] = mass > 0 ? sums[2 + a].value() / mass : 0;
          cells.velocities[3 * cell + a] = mean[a];
        }
        cells.radius[cell] = sums[0].value() > 0 ? sums[5].value() / sums[0].value() : 0;
        cells.volume_fraction[cell] = sums[6].value() / size;
        std::array<BigSum, 6> stress;
        constexpr int axes[6][2] = { { 0, 0 }, { 1, 1 }, { 2, 2 }, { 0, 1 }, { 0, 2 }, { 1, 2 } };
        for (const Particle& particle : particles)
        {
          const double share = share_of(particle, lo, hi).first;
          for (std::size_t n = 0; share > 0 && n < 6; ++n)
          {
            const auto a = static_cast<std::size_t>(axes[n][0]);
            const auto b = static_cast<std::size_t>(axes[n][1]);
            // what rounding of the mean may make is no motion
            const auto apart = [&](std::size_t along)
            {
              const double difference = particle.v[along] - mean[along];
              return std::abs(difference) > 0x1p-49 * std::abs(mean[along]) ? difference : 0;
            };
            stress[n].add(
              -(particle.mass * share) * apart(a) * apart(b) + particle.stress[n] * share);
          }
        }
        for (std::size_t n = 0; n < 3; ++n)
        {
          cells.normal_stress[3 * cell + n] = stress[n].value() / size;
          cells.shear_stress[3 * cell + n] = stress[3 + n].value() / size;
        }
        cells.pressure[cell] =
          -(stress[0].value() + stress[1].value() + stress[2].value()) / (3 * size);
      }
    }
  }
  return cells;
}

/// lo <= x < hi; at the upper end of the grid x <= hi.
inline bool is_inside(const Particle& particle, const granular::EulerGrid& grid,
  const granular::Vector3& lo, const granular::Vector3& hi)
{
  bool inside = true;
  for (std::size_t a = 0; a < 3; ++a)
  {
    const bool below = particle.x[a] < hi[a] || (hi[a] == grid.hi[a] && particle.x[a] == hi[a]);
    inside = inside && particle.x[a] >= lo[a] && below;
  }
  return inside;
}

inline granular::EulerCells average_by_centre(
  const std::vector<Particle>& particles, const granular::EulerGrid& grid)
{
  return average_one_by_one(particles, grid,
    [&](const Particle& particle, const granular::Vector3& lo, const granular::Vector3& hi)
    {
      return is_inside(particle, grid, lo, hi) ? Share(1, granular::sphere_volume(particle.radius))
                                               : Share(0, 0);
    });
}
#endif
