// SPDX-License-Identifier: BSD-3-Clause
#include "granular/contacts/point_average.h"

#include "granular/contacts/near_points.h"
#include "granular/contacts/point_sources.h"
#include "granular/euler/grain_values.h"
#include "granular/geometry/rounded_sums.h"

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

/// Sums of some terms at a point, in any order.
template <std::size_t count>
class TermSums
{
public:
  using Terms = std::array<double, count>;

  /// Sums make(i, terms) for i below n; make returns false for what has none.
  template <class Make>
  static Terms sum(std::size_t n, const Make& make)
  {
    RoundedSums<count> sums;
    Terms terms;
    for (std::size_t i = 0; i < n; ++i)
    {
      if (make(i, terms))
      {
        sums.add(terms);
      }
    }
    Terms all;
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
};

class PointPasses
{
public:
  PointPasses(const FrameView& frame, std::span<const double> points, const FoundEnds* contacts,
    const PointAverageRequest& request, Communicator& ranks, const Executor& executor,
    Progress& progress)
    : frame_(frame)
    , points_(points)
    , contacts_(contacts)
    , request_(request)
    , ranks_(ranks)
    , executor_(executor)
    , progress_(progress)
    , support_(request.kernel.support())
    , per_volume_(1 / request.kernel.volume())
  {
  }

  EulerAverages run(const GrainSources& sources)
  {
    // a little more than the support, as the kernel decides by rounded distances
    const double reach = support_ * (1 + 0x1p-48);
    const Extent own = extent_of(points_).grown(reach);
    progress_.set_part(0, 0.2);
    const PointSources found =
      find_point_sources(frame_, sources, contacts_, own, ranks_, progress_);
    const std::vector<NearGrain>& grains = found.grains;
    const std::vector<NearLine>& lines = found.lines;
    result_.broken = found.broken;
    this->make_room();
    std::vector<Extent> reaches(grains.size());
    std::ranges::transform(grains, reaches.begin(),
      [&](const NearGrain& grain) {
        return Extent{ grain.place, grain.place }.grown(reach);
      });
    const Bins near_grains(own, 2 * support_, reaches);
    reaches.resize(lines.size());
    std::ranges::transform(
      lines, reaches.begin(), [&](const NearLine& line) { return extent_of(line).grown(reach); });
    const Bins near_lines(own, 2 * support_, reaches);
    progress_.set_part(0.2, 1);
    executor_.for_each_stretch(
      points_.size() / 3, points_of_stretch,
      [&](std::size_t first, std::size_t count, std::size_t)
      {
        for (std::size_t i = first; i < first + count; ++i)
        {
          const Vector3 point = { points_[3 * i], points_[3 * i + 1], points_[3 * i + 2] };
          const double share = this->add_grains(i, point, grains, near_grains.near(point));
          if (contacts_)
          {
            this->add_lines(i, point, lines, near_lines.near(point), share);
          }
        }
      },
      progress_);
    return std::move(result_);
  }

private:
  void make_room()
  {
    const std::size_t count = points_.size() / 3;
    EulerCells& cells = result_.cells;
    EulerFields& fields = result_.fields;
    cells.resize(static_cast<std::int64_t>(count));
    cells.centres.clear();
    const auto room = [&](bool wanted, std::size_t width) { return wanted ? width * count : 0; };
    cells.normal_stress.resize(room(request_.tensors, 3));
    cells.shear_stress.resize(room(request_.tensors, 3));
    fields.density.resize(room(request_.fields.density, 1));
    fields.momentum.resize(room(request_.fields.momentum, 3));
    fields.temperature.resize(room(request_.fields.temperature, 1));
    fields.coordination.resize(room(contacts_ && request_.fields.coordination, 1));
    fields.fabric.resize(room(contacts_ && request_.fields.fabric, 6));
    fields.contact_normal.resize(
      room(contacts_ && request_.tensors && contacts_->have_forces(), 3));
    fields.contact_shear.resize(fields.contact_normal.size());
  }

  double weight(const NearGrain& grain, const Vector3& point) const noexcept
  {
    const Vector3 r = { point[0] - grain.place[0], point[1] - grain.place[1],
      point[2] - grain.place[2] };
    return request_.kernel.value(dot(r, r)) * per_volume_;
  }

  /// Returns the sum of the weights.
  double add_grains(std::size_t to, const Vector3& point, const std::vector<NearGrain>& grains,
    std::span<const std::uint32_t> near)
  {
    EulerCells& cells = result_.cells;
    const auto sums = TermSums<7>::sum(near.size(),
      [&](std::size_t i, TermSums<7>::Terms& terms)
      {
        const NearGrain& grain = grains[near[i]];
        const double w = this->weight(grain, point);
        const double mass = w * grain.mass;
        const auto& [x, y, z] = grain.velocity;
        terms = { w, mass, mass * x, mass * y, mass * z, w * grain.radius, w * grain.volume };
        return w > 0;
      });
    const auto& [share, mass, x, y, z, radius, volume] = sums;
    const Vector3 momentum = { x, y, z };
    Vector3 mean = {};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      mean[axis] = mass > 0 ? momentum[axis] / mass : 0;
      cells.velocities[3 * to + axis] = mean[axis];
      if (request_.fields.momentum)
      {
        result_.fields.momentum[3 * to + axis] = momentum[axis];
      }
    }
    cells.volume_fraction[to] = volume;
    cells.radius[to] = share > 0 ? radius / share : 0;
    if (request_.fields.density)
    {
      result_.fields.density[to] = mass;
    }
    if (request_.pressure || request_.tensors || request_.fields.temperature)
    {
      this->add_fluctuations(to, point, grains, near, mean, mass);
    }
    return share;
  }

  void add_fluctuations(std::size_t to, const Vector3& point, const std::vector<NearGrain>& grains,
    std::span<const std::uint32_t> near, const Vector3& mean, double mass)
  {
    EulerCells& cells = result_.cells;
    const auto sums = TermSums<7>::sum(near.size(),
      [&](std::size_t i, TermSums<7>::Terms& terms)
      {
        const NearGrain& grain = grains[near[i]];
        const double w = this->weight(grain, point);
        const double part = w * grain.mass;
        const double x = deviation(grain.velocity[0], mean[0]);
        const double y = deviation(grain.velocity[1], mean[1]);
        const double z = deviation(grain.velocity[2], mean[2]);
        terms = { -part * x * x, -part * y * y, -part * z * z, -part * x * y, -part * x * z,
          -part * y * z, part * (x * x + y * y + z * z) };
        return w > 0;
      });
    cells.pressure[to] = (0 - (sums[0] + sums[1] + sums[2])) / 3;
    for (std::size_t k = 0; request_.tensors && k < 3; ++k)
    {
      cells.normal_stress[3 * to + k] = sums[k];
      cells.shear_stress[3 * to + k] = sums[3 + k];
    }
    if (request_.fields.temperature)
    {
      result_.fields.temperature[to] = mass > 0 ? sums[6] / (3 * mass) : 0;
    }
  }

  void add_lines(std::size_t to, const Vector3& point, const std::vector<NearLine>& lines,
    std::span<const std::uint32_t> near, double share)
  {
    EulerFields& fields = result_.fields;
    std::vector<double> means(near.size());
    for (std::size_t i = 0; i < near.size(); ++i)
    {
      const NearLine& line = lines[near[i]];
      means[i] = per_volume_ *
        request_.kernel.line_mean(
          { point[0] - line.start[0], point[1] - line.start[1], point[2] - line.start[2] },
          line.branch);
    }
    const auto sums = TermSums<14>::sum(near.size(),
      [&](std::size_t i, TermSums<14>::Terms& terms)
      {
        const NearLine& line = lines[near[i]];
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
    for (std::size_t k = 0; !fields.contact_normal.empty() && k < 3; ++k)
    {
      fields.contact_normal[3 * to + k] = sums[k];
      fields.contact_shear[3 * to + k] = sums[3 + k];
    }
    if (!fields.coordination.empty())
    {
      fields.coordination[to] = share > 0 ? sums[6] / share : 0;
    }
    for (std::size_t k = 0; !fields.fabric.empty() && k < 6; ++k)
    {
      fields.fabric[6 * to + k] = sums[7] > 0 ? sums[8 + k] / sums[7] : 0;
    }
  }

  const FrameView& frame_;
  std::span<const double> points_;
  const FoundEnds* contacts_;
  const PointAverageRequest& request_;
  Communicator& ranks_;
  const Executor& executor_;
  PartialProgress progress_;
  double support_;
  double per_volume_;
  EulerAverages result_;
};
}

EulerAverages average_at_points(const FrameView& frame, std::span<const double> points,
  const FoundEnds* contacts, const PointAverageRequest& request, Communicator& ranks,
  const Executor& executor, Notices& notices, Progress& progress)
{
  return do_together(ranks,
    [&]
    {
      const GrainSources sources = find_grain_sources(frame, request.arrays);
      check_grains(frame, sources, request.arrays, false, ranks, notices);
      return PointPasses(frame, points, contacts, request, ranks, executor, progress).run(sources);
    });
}
}
