// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/average.h"

#include "granular/averages/particle_loader.h"
#include "granular/averages/point_sources.h"
#include "granular/geometry/reproducible_sum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace granular
{
namespace
{
constexpr std::size_t points_of_stretch = 256;

/// Sums make(i, terms) for i below n, in any order; make returns false for what has none.
template <std::size_t count, class Make>
std::array<double, count> sum_terms(std::size_t n, const Make& make)
{
  RoundedSums<count> sums;
  std::array<double, count> terms;
  for (std::size_t i = 0; i < n; ++i)
  {
    if (make(i, terms))
    {
      sums.add(terms);
    }
  }
  std::array<double, count> all;
  for (std::size_t k = 0; k < count; ++k)
  {
    if (!sums.round(k, all[k]) && std::isfinite(all[k]))
    {
      ExactSum exact;
      for (std::size_t i = 0; i < n; ++i)
      {
        if (make(i, terms))
        {
          exact.add(terms[k]);
        }
      }
      all[k] = exact.rounded();
    }
  }
  return all;
}

/// The sources of averages at points, and the averages.
struct PointSums
{
  using Near = std::span<const std::uint32_t>;

  /// Returns the sum of the weights.
  double add_particles(std::size_t to, const Vector3& point, Near near)
  {
    const auto weight = [&](const NearParticle& particle)
    {
      const Vector3 r = { point[0] - particle.place[0], point[1] - particle.place[1],
        point[2] - particle.place[2] };
      return request.kernel.value(dot(r, r)) * per_volume;
    };
    const auto sums = sum_terms<7>(near.size(),
      [&](std::size_t i, std::array<double, 7>& terms)
      {
        const NearParticle& particle = found.particles[static_cast<std::size_t>(near[i])];
        const double w = weight(particle);
        const double mass = w * particle.mass;
        const auto& [x, y, z] = particle.velocity;
        terms = { w, mass, mass * x, mass * y, mass * z, w * particle.radius, w * particle.volume };
        return w > 0;
      });
    const Vector3 mean = mean_velocity(&sums[1]);
    averages.store_means(to, sums.data(), mean, 1);
    if (request.pressure || request.tensors || request.fields.temperature)
    {
      const auto fluctuations = sum_terms<7>(near.size(),
        [&](std::size_t i, std::array<double, 7>& terms)
        {
          const NearParticle& particle = found.particles[static_cast<std::size_t>(near[i])];
          const double w = weight(particle);
          terms = fluctuation_terms(w * particle.mass, particle.velocity.data(), mean);
          return w > 0;
        });
      averages.store_fluctuations(to, fluctuations.data(), sums[1], 1);
    }
    return sums[0];
  }

  void add_lines(std::size_t to, const Vector3& point, Near near, double share)
  {
    std::vector<double> means(near.size());
    for (std::size_t i = 0; i < near.size(); ++i)
    {
      const NearLine& line = found.lines[static_cast<std::size_t>(near[i])];
      means[i] = per_volume *
        request.kernel.line_mean(
          { point[0] - line.start[0], point[1] - line.start[1], point[2] - line.start[2] },
          line.branch);
    }
    const auto sums = sum_terms<14>(near.size(),
      [&](std::size_t i, std::array<double, 14>& terms)
      {
        const NearLine& line = found.lines[static_cast<std::size_t>(near[i])];
        const double w = means[i];
        const auto& [x, y, z] = line.branch;
        const auto& [fx, fy, fz] = line.force;
        const auto& [nx, ny, nz] = line.normal;
        const double counted = line.normal == Vector3{} ? 0 : w * line.counts;
        terms = { w * (x * fx), w * (y * fy), w * (z * fz), w * (x * fy), w * (x * fz),
          w * (y * fz), w * line.ends, counted, counted * (nx * nx), counted * (ny * ny),
          counted * (nz * nz), counted * (nx * ny), counted * (nx * nz), counted * (ny * nz) };
        return w > 0;
      });
    averages.store_contacts(to, sums.data(), share, 1);
    averages.store_fabric(to, &sums[8], sums[7]);
  }

  const PointAverageRequest& request;
  const PointSources& found;
  double per_volume;
  EulerAverages averages = {};
};

Bins bins_of(const Extent& whole, double edge, double reach, const auto& things)
{
  std::vector<Extent> reaches(things.size());
  std::ranges::transform(
    things, reaches.begin(), [&](const auto& thing) { return extent_of(thing).grown(reach); });
  return { whole, edge, reaches };
}
}

EulerAverages average_at_points(const FrameView& frame, std::span<const double> points,
  const FoundEnds* contacts, const PointAverageRequest& request, Communicator& ranks,
  const Executor& executor, Notices& notices, Progress& progress)
{
  return do_together(ranks,
    [&]
    {
      const ParticleSources sources = find_particle_sources(frame, request.arrays);
      check_particles(frame, sources, request.arrays, false, ranks, notices);
      // a little more than the support, as the kernel decides by rounded distances
      const double support = request.kernel.support();
      const double reach = support * (1 + 0x1p-48);
      const Extent own = extent_of(points).grown(reach);
      PartialProgress parts(progress);
      parts.set_part(0, 0.2);
      const PointSources found = find_point_sources(frame, sources, contacts, own, ranks, parts);
      const auto count = static_cast<std::int64_t>(points.size() / 3);
      PointSums sums = { request, found, 1 / request.kernel.volume() };
      sums.averages.broken = found.broken;
      sums.averages.make_room(count, request.tensors, request.fields);
      sums.averages.cells.centres.clear();
      if (contacts)
      {
        sums.averages.make_contact_room(
          count, request.tensors && contacts->have_forces(), request.fields);
      }
      const Bins near_particles = bins_of(own, 2 * support, reach, found.particles);
      const Bins near_lines = bins_of(own, 2 * support, reach, found.lines);
      parts.set_part(0.2, 1);
      executor.for_each_stretch(
        points.size() / 3, points_of_stretch,
        [&](std::size_t first, std::size_t size, std::size_t)
        {
          for (std::size_t i = first; i < first + size; ++i)
          {
            const Vector3 point = { points[3 * i], points[3 * i + 1], points[3 * i + 2] };
            const double share = sums.add_particles(i, point, near_particles.near(point));
            if (contacts)
            {
              sums.add_lines(i, point, near_lines.near(point), share);
            }
          }
        },
        parts);
      return std::move(sums.averages);
    });
}
}
