// SPDX-License-Identifier: BSD-3-Clause
#include "granular/averages/point_sources.h"

#include "granular/grid/periodic_images.h"
#include "granular/grid/sphere_box.h"
#include "granular/parallel/trade.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace granular
{
namespace
{
constexpr auto most_rows = static_cast<std::int64_t>(ParticleBlock::most_rows);

/// Extents of the points of all ranks.
using Extents = std::vector<Extent>;

/// The images that reach into what the points of all ranks reach.
PeriodicImages find_images(const FrameView& frame, const Extents& extents)
{
  Extent all;
  for (const Extent& extent : extents)
  {
    if (!extent.empty())
    {
      all.include(extent.lo);
      all.include(extent.hi);
    }
  }
  const EulerGrid grid = all.empty() ? EulerGrid{ {}, { 1, 1, 1 }, { 1, 1, 1 } }
                                     : EulerGrid{ all.lo, all.hi, { 1, 1, 1 } };
  return PeriodicImages(grid, frame.has_box ? &frame.header.box : nullptr);
}

/// Adds what reaches the points of any rank.
template <class Thing>
void add(const Thing& thing, const Extents& extents, std::vector<Thing>& things)
{
  const Extent own = extent_of(thing);
  if (std::ranges::any_of(extents, [&](const Extent& extent) { return own.meets(extent); }))
  {
    things.push_back(thing);
  }
}

/// Sends what reaches the points of a rank to it.
template <class Thing>
std::vector<Thing> send(std::vector<Thing> things, const Extents& extents, Communicator& ranks)
{
  if (ranks.size() == 1)
  {
    return things;
  }
  std::vector<Thing> out;
  std::vector<std::int64_t> counts;
  for (const Extent& wanted : extents)
  {
    const std::size_t before = out.size();
    std::ranges::copy_if(things, std::back_inserter(out),
      [&](const Thing& thing) { return extent_of(thing).meets(wanted); });
    counts.push_back(static_cast<std::int64_t>(out.size() - before));
  }
  return trade(out, counts, swap_numbers(counts, ranks), ranks);
}

std::vector<NearParticle> find_particles(const FrameView& frame, const ParticleSources& sources,
  const Extents& extents, std::int64_t& broken, Progress& progress)
{
  const ParticleLoader values(frame, sources);
  const PeriodicImages images = find_images(frame, extents);
  images.check(0);
  std::vector<NearParticle> particles;
  ParticleBlock block;
  std::vector<std::int64_t> rows(ParticleBlock::most_rows);
  ParticleLoader::Scan scan;
  for (std::int64_t first = 0; first < frame.rows; first += most_rows)
  {
    const auto count = std::min(frame.rows - first, most_rows);
    std::iota(rows.begin(), rows.begin() + count, first);
    values.scan(std::span(rows).first(static_cast<std::size_t>(count)), block, scan);
    for (std::size_t i = 0; i < block.rows; ++i)
    {
      if (block.uses(i))
      {
        const double* const v = block.velocities + 3 * i;
        images.each(block.positions + 3 * i, 0,
          [&](const Twofold3& image)
          {
            const NearParticle particle = { values_of(image), { v[0], v[1], v[2] }, block.mass[i],
              block.radius[i], sphere_volume(block.radius[i]) };
            add(particle, extents, particles);
          });
      }
    }
    progress.step(static_cast<double>(first) / static_cast<double>(frame.rows));
  }
  broken = scan.broken;
  return particles;
}

/// The longest component of the branches of all ranks.
double find_longest(const FoundEnds& contacts, Communicator& ranks)
{
  double longest = 0;
  for (std::size_t i = 0; i < contacts.rows(); ++i)
  {
    const auto [ends, row] = contacts.at(static_cast<std::int64_t>(i));
    if (ends.has_line(row))
    {
      const auto [x, y, z] = ends.branch(row);
      longest = std::max({ longest, std::abs(x), std::abs(y), std::abs(z) });
    }
  }
  return std::ranges::max(gather(ranks, longest));
}

std::vector<NearLine> find_lines(const FrameView& frame, const FoundEnds& contacts,
  const Extents& extents, Communicator& ranks, Progress& progress)
{
  const PeriodicImages images = find_images(frame, extents);
  images.check(find_longest(contacts, ranks) / 2);
  std::vector<NearLine> lines;
  for (std::size_t i = 0; i < contacts.rows(); ++i)
  {
    if (i % 65536 == 0)
    {
      progress.step(static_cast<double>(i) / static_cast<double>(contacts.rows()));
    }
    const auto [ends, row] = contacts.at(static_cast<std::int64_t>(i));
    if (!ends.has_line(row))
    {
      continue;
    }
    NearLine line;
    const Vector3 start = ends.first(row);
    line.branch = ends.branch(row);
    line.normal = ContactEnds::normal(line.branch);
    line.counts = ends.counts(row);
    line.ends = line.counts * (ends.is_wall() ? 1 : 2);
    line.force = ends.force(row);
    Vector3 middle;
    Vector3 reach;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      line.force[axis] *= ends.is_wall() ? -1 : 1;
      middle[axis] = start[axis] + line.branch[axis] / 2;
      reach[axis] = std::abs(line.branch[axis]) / 2;
    }
    images.each(middle.data(), reach,
      [&](const Twofold3& image)
      {
        for (std::size_t axis = 0; axis < 3; ++axis)
        {
          line.start[axis] = start[axis] + (image[axis].hi - middle[axis] + image[axis].lo);
        }
        add(line, extents, lines);
      });
  }
  return lines;
}
}

Extent extent_of(const NearParticle& particle) noexcept
{
  return { particle.place, particle.place };
}

Extent extent_of(const NearLine& line) noexcept
{
  Extent extent;
  extent.include(line.start);
  extent.include({ line.start[0] + line.branch[0], line.start[1] + line.branch[1],
    line.start[2] + line.branch[2] });
  return extent;
}

PointSources find_point_sources(const FrameView& frame, const ParticleSources& sources,
  const FoundEnds* contacts, const Extent& wanted, Communicator& ranks, Progress& progress)
{
  return do_together(ranks,
    [&]
    {
      const Extents extents = gather(ranks, wanted);
      PointSources found;
      found.particles = find_particles(frame, sources, extents, found.broken, progress);
      ranks.sum({ &found.broken, 1 });
      found.particles = send(std::move(found.particles), extents, ranks);
      if (contacts)
      {
        found.lines = send(find_lines(frame, *contacts, extents, ranks, progress), extents, ranks);
      }
      return found;
    });
}

bool Extent::meets(const Extent& other) const noexcept
{
  bool meets = true;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    meets = meets && lo[axis] <= other.hi[axis] && hi[axis] >= other.lo[axis];
  }
  return meets;
}

void Extent::include(const Vector3& point) noexcept
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    lo[axis] = std::min(lo[axis], point[axis]);
    hi[axis] = std::max(hi[axis], point[axis]);
  }
}

Extent Extent::grown(double by) const noexcept
{
  Extent grown = *this;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    grown.lo[axis] = std::nextafter(grown.lo[axis] - by, -HUGE_VAL);
    grown.hi[axis] = std::nextafter(grown.hi[axis] + by, HUGE_VAL);
  }
  return grown;
}

Extent extent_of(std::span<const double> points) noexcept
{
  Extent extent;
  for (std::size_t i = 0; i + 3 <= points.size(); i += 3)
  {
    const Vector3 point = { points[i], points[i + 1], points[i + 2] };
    if (std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]))
    {
      extent.include(point);
    }
  }
  return extent;
}

Bins::Bins(const Extent& whole, double edge, std::span<const Extent> things)
  : whole_(whole)
{
  if (whole.empty())
  {
    return;
  }
  // as many bins as there are things, or some more
  const double most = 4 * static_cast<double>(things.size()) + 64;
  double count = 1;
  std::array<double, 3> counts;
  for (double by = edge;; by *= 2)
  {
    count = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      counts[axis] =
        std::floor(whole.hi[axis] / by - whole.lo[axis] / by) + 1; // no overflow in the end
      per_edge_[axis] = 1 / by;
      count *= counts[axis];
    }
    if (count <= most)
    {
      break;
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    all_.last[axis] = static_cast<std::int64_t>(counts[axis]);
  }
  starts_.resize(static_cast<std::size_t>(all_.size()) + 1);
  const auto each_bin = [&](const Extent& thing, const auto& take)
  {
    if (thing.meets(whole_))
    {
      this->range(thing).each([&](const std::array<std::int64_t, 3>& bin)
        { take(static_cast<std::size_t>(all_.number(bin))); });
    }
  };
  for (const Extent& thing : things)
  {
    each_bin(thing, [&](std::size_t bin) { ++starts_[bin + 1]; });
  }
  std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
  things_.resize(static_cast<std::size_t>(starts_.back()));
  std::vector<std::int64_t> next(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < things.size(); ++i)
  {
    each_bin(things[i],
      [&](std::size_t bin)
      { things_[static_cast<std::size_t>(next[bin]++)] = static_cast<std::uint32_t>(i); });
  }
}

CellRange Bins::range(const Extent& extent) const noexcept
{
  CellRange range;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto bin = [&](double x)
    {
      const double place = std::floor((x - whole_.lo[axis]) * per_edge_[axis]);
      return static_cast<std::int64_t>(
        std::clamp(place, 0.0, static_cast<double>(all_.last[axis] - 1)));
    };
    range.first[axis] = bin(extent.lo[axis]);
    range.last[axis] = bin(extent.hi[axis]) + 1;
  }
  return range;
}

std::span<const std::uint32_t> Bins::near(const Vector3& point) const noexcept
{
  if (!Extent{ point, point }.meets(whole_)) // false for nan
  {
    return {};
  }
  const auto bin = static_cast<std::size_t>(all_.number(this->range({ point, point }).first));
  const auto first = static_cast<std::size_t>(starts_[bin]);
  return std::span(things_).subspan(first, static_cast<std::size_t>(starts_[bin + 1]) - first);
}
}
